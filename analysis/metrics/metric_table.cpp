#include "analysis/metrics/metric_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::analysis {

namespace {

using scene::ClassReason;
using scene::PixelClass;

constexpr MetricValue none{};

MetricValue number(const std::optional<double>& value)
{
    return value ? MetricValue{*value} : none;
}
/// A limit that does not exist is infinite.
MetricValue finite(float value)
{
    return std::isfinite(value) ? MetricValue{double{value}} : none;
}

/// A count of pixels, of which more are worse.
MetricDescription pixel_count(std::string name, std::string meaning, Worse worse = Worse::up)
{
    return {std::move(name), MetricType::count, "px", std::move(meaning), worse};
}
/// A number of which more is worse.
MetricDescription measured(std::string name, std::string_view unit, std::string meaning,
                           Worse worse = Worse::up)
{
    return {std::move(name), MetricType::number, unit, std::move(meaning), worse};
}
MetricDescription titled(MetricDescription metric, std::string_view title)
{
    metric.title = title;
    return metric;
}
MetricDescription outcome(MetricDescription metric, std::string_view title)
{
    metric.is_outcome = true;
    return titled(std::move(metric), title);
}

void add_classes(ConfigurationMetrics& metrics)
{
    metrics.push_back({pixel_count("pixels.total", "width × height", Worse::both),
                       [](const ConfigurationResult& result) {
                           return MetricValue{result.metrics.pixels.total};
                       }});
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        const auto pixel_class = static_cast<PixelClass>(i);
        const bool is_failure =
            pixel_class == PixelClass::unmatched || pixel_class == PixelClass::indeterminate;
        metrics.push_back({pixel_count(fmt::format("pixels.{}", scene::pixel_class_names[i]),
                                       i == 0 ? "pixels of each [class](truth.md)" : "",
                                       is_failure ? Worse::up : Worse::both),
                           [pixel_class](const ConfigurationResult& result) {
                               return MetricValue{result.metrics.pixels.of(pixel_class)};
                           }});
    }
}

void add_reasons(ConfigurationMetrics& metrics)
{
    struct Reason {
        const char* name;
        const char* meaning;
        ClassReason reason;
    };
    for (const Reason& one : {
             Reason{"unmatched_kinds.snap", "unmatched pixels by kind", ClassReason::snap},
             {"unmatched_kinds.tie", "", ClassReason::tie},
             {"unmatched_kinds.mismatch", "", ClassReason::mismatch},
             {"indeterminate_kinds.silhouette", "indeterminate pixels by kind",
              ClassReason::silhouette},
             {"indeterminate_kinds.vertex", "", ClassReason::vertex},
             {"indeterminate_kinds.graze", "", ClassReason::graze},
         }) {
        metrics.push_back({pixel_count(one.name, one.meaning),
                           [reason = one.reason](const ConfigurationResult& result) {
                               return MetricValue{result.metrics.pixels.of(reason)};
                           }});
    }
}

void add_errors(ConfigurationMetrics& metrics)
{
    const auto add = [&](MetricDescription metric, auto value) {
        metrics.push_back({std::move(metric), [value](const ConfigurationResult& result) {
                               return value(result.metrics);
                           }});
    };
    add(outcome(pixel_count("false_shadow", "truth lit, verdict below one half"),
                "false shadow [pixels]"),
        [](const Metrics& of) { return MetricValue{of.false_shadow}; });
    add(outcome(pixel_count("false_lit", "truth blocked, verdict at least one half"),
                "false lit [pixels]"),
        [](const Metrics& of) { return MetricValue{of.false_lit}; });
    add(outcome(measured("false_shadow_rate", "", "`false_shadow` / `pixels.lit`"),
                "false-shadow rate"),
        [](const Metrics& of) { return number(of.false_shadow_rate); });
    add(outcome(measured("false_lit_rate", "", "`false_lit` / `pixels.blocked`"), "false-lit rate"),
        [](const Metrics& of) { return number(of.false_lit_rate); });
    add(outcome(measured("error_rate", "",
                         "(`false_shadow` + `false_lit`) / (`pixels.lit` + `pixels.blocked`)"),
                "error rate"),
        [](const Metrics& of) { return number(of.error_rate); });
    add(outcome(measured("mean_abs_error", "",
                         "mean of \\|verdict − truth\\| over lit and blocked pixels: both amounts "
                         "/ (`pixels.lit` + `pixels.blocked`)"),
                "mean absolute error"),
        [](const Metrics& of) { return number(of.mean_abs_error); });
    add(outcome(measured("shadow_amount", "px",
                         "[amount](errors.md#amounts) of false shadow: Σ (1 − verdict) over lit "
                         "pixels"),
                "amount of false shadow [pixels]"),
        [](const Metrics& of) { return MetricValue{of.amounts.shadow}; });
    add(outcome(
            measured("light_amount", "px", "amount of false light: Σ verdict over blocked pixels"),
            "amount of false light [pixels]"),
        [](const Metrics& of) { return MetricValue{of.amounts.light}; });
    add(titled(measured("shadow_amount_rate", "", "`shadow_amount` / `pixels.lit`"),
               "amount of false shadow per lit pixel"),
        [](const Metrics& of) { return number(of.shadow_amount_rate); });
    add(titled(measured("light_amount_rate", "", "`light_amount` / `pixels.blocked`"),
               "amount of false light per blocked pixel"),
        [](const Metrics& of) { return number(of.light_amount_rate); });
    add(titled(pixel_count("partial",
                           "scored pixels on the right side of one half whose verdict is "
                           "more than 1/256 from the truth"),
               "partial [pixels]"),
        [](const Metrics& of) { return MetricValue{of.amounts.partial}; });
    add(measured("unassigned", "px",
                 "the part of both amounts from right pixels that are not partial"),
        [](const Metrics& of) { return MetricValue{of.amounts.unassigned}; });
}

/// The first name, "none", is left out.
template <std::size_t size>
void add_counts_by_name(ConfigurationMetrics& metrics, std::string_view group,
                        const std::array<std::string_view, size>& names,
                        std::span<const std::string_view> titles, const std::string& meaning,
                        std::array<std::uint64_t, size> CauseCounts::*counts)
{
    for (std::size_t i = 1; i < size; ++i) {
        metrics.push_back(
            {titled(pixel_count(fmt::format("{}.{}", group, names.at(i)), i == 1 ? meaning : ""),
                    i <= titles.size() ? titles[i - 1] : ""),
             [i, counts](const ConfigurationResult& result) {
                 return result.causes ? MetricValue{((*result.causes).*counts).at(i)} : none;
             }});
    }
}

void add_causes(ConfigurationMetrics& metrics)
{
    static constexpr std::array<std::string_view, 4> label_titles{
        "acne [pixels]", "peter panning [pixels]", "leaks [pixels]", "edge errors [pixels]"};
    add_counts_by_name(metrics, "causes", cause_names, {}, "wrong pixels by [cause](causes.md)",
                       &CauseCounts::by_cause);
    add_counts_by_name(metrics, "labels", label_names, label_titles,
                       "wrong pixels by [name](causes.md#the-names)", &CauseCounts::by_label);
}

/// The first name, "none", is left out.
template <std::size_t size>
void add_amounts_by_name(ConfigurationMetrics& metrics, std::string_view group,
                         const std::array<std::string_view, size>& names,
                         const std::string& meaning,
                         std::array<double, size> CauseAmounts::*amounts)
{
    for (std::size_t i = 1; i < size; ++i) {
        metrics.push_back(
            {measured(fmt::format("{}.{}", group, names.at(i)), "px", i == 1 ? meaning : ""),
             [i, amounts](const ConfigurationResult& result) {
                 return result.causes ? MetricValue{(result.amounts.*amounts).at(i)} : none;
             }});
    }
}

void add_cause_amounts(ConfigurationMetrics& metrics)
{
    add_amounts_by_name(metrics, "cause_amounts", cause_names,
                        "amounts of wrong and partial pixels by [cause](causes.md)",
                        &CauseAmounts::by_cause);
    add_amounts_by_name(metrics, "label_amounts", label_names,
                        "amounts of wrong and partial pixels by [name](causes.md#the-names)",
                        &CauseAmounts::by_label);
    const auto add = [&](MetricDescription metric, auto value) {
        metrics.push_back({std::move(metric), [value](const ConfigurationResult& result) {
                               return result.causes ? MetricValue{value(result.amounts)} : none;
                           }});
    };
    add(titled(measured("softening", "px",
                        "the part of the amounts that a kernel softens borders by on purpose: "
                        "`edge` by `filter`"),
               "softening [pixels]"),
        [](const CauseAmounts& amounts) { return amounts.softening(); });
    add(measured("shadow_softening", "px", "the same of `shadow_amount`"),
        [](const CauseAmounts& amounts) { return amounts.shadow_softening; });
    add(measured("light_softening", "px", "the same of `light_amount`"),
        [](const CauseAmounts& amounts) { return amounts.light_softening; });
}

void add_gaps(ConfigurationMetrics& metrics)
{
    for (const auto& [unit, lengths] : {std::pair{"m", &Gaps::metres}, {"texels", &Gaps::texels}}) {
        const std::string meaning = fmt::format("[gaps](causes.md#gaps) in {}",
                                                unit == std::string_view{"m"} ? "metres" : unit);
        for (const auto& [name, member] : {std::pair{"median", &Quantiles::median},
                                           {"p95", &Quantiles::p95},
                                           {"max", &Quantiles::max}}) {
            metrics.push_back(
                {measured(fmt::format("peter_panning_gap_{}.{}", unit, name), unit,
                          member == &Quantiles::median ? meaning : ""),
                 [lengths = lengths, member = member](const ConfigurationResult& result) {
                     const auto& gaps = result.peter_panning.*lengths;
                     return gaps ? finite((*gaps).*member) : none;
                 }});
        }
    }
    metrics.push_back({pixel_count("peter_panning_gap_pixels",
                                   "pixels that have a gap: those of `labels.peter_panning`"),
                       [](const ConfigurationResult& result) {
                           const auto& gaps = result.peter_panning.metres;
                           return result.causes ? MetricValue{gaps ? std::uint64_t{gaps->count} : 0}
                                                : none;
                       }});
}

void add_best(CurveMetrics& metrics)
{
    const auto add_end = [&](const char* name, std::string meaning, float BiasInterval::*end) {
        metrics.push_back({measured(name, "depth units", std::move(meaning), Worse::both),
                           [end](const CurveResult& curve) {
                               return curve.best ? finite(curve.best->interval.*end) : none;
                           }});
    };
    add_end(
        "bias_curve.best_interval.lo",
        "the constant biases with the fewest errors, all else equal; for this and all below see "
        "[bias_curve.md](bias_curve.md)",
        &BiasInterval::lo);
    add_end("bias_curve.best_interval.hi", "", &BiasInterval::hi);
    metrics.push_back(
        {outcome(pixel_count("bias_curve.best_errors", "wrong pixels with any of them"),
                 "errors at the best bias [pixels]"),
         [](const CurveResult& curve) {
             return curve.best ? MetricValue{curve.best->errors.total()} : none;
         }});
}

/// What is recommended: no change of it is worse or better by itself.
void add_recommended(CurveMetrics& metrics)
{
    const auto add = [&](const std::string& name, std::string_view unit, std::string meaning,
                         const std::function<double(const Recommendation&)>& value) {
        metrics.push_back({MetricDescription{"bias_curve.recommended." + name,
                                             MetricType::number,
                                             unit,
                                             std::move(meaning),
                                             {}},
                           [value](const CurveResult& curve) {
                               const double found = curve.recommended
                                                        ? value(*curve.recommended)
                                                        : std::numeric_limits<double>::quiet_NaN();
                               return std::isfinite(found) ? MetricValue{found} : none;
                           }});
    };
    struct Length {
        const char* name;
        const char* meaning;
        BiasLength Recommendation::*length;
    };
    for (const auto& [name, meaning, length] :
         {Length{"bias",
                 "the recommended constant bias: the middle of the lowest broad valley of the "
                 "amount of error without softening; in metres along the light's axis and in "
                 "texels at the "
                 "median receiver",
                 &Recommendation::bias},
          Length{"low", "where that valley begins", &Recommendation::low},
          Length{"high", "and ends; without a value where nothing limits it",
                 &Recommendation::high}}) {
        const auto of = [length = length](auto BiasLength::*unit) {
            return [=](const Recommendation& r) { return double{r.*length.*unit}; };
        };
        add(name, "depth units", meaning, of(&BiasLength::depth));
        add(fmt::format("{}_m", name), "m", "", of(&BiasLength::metres));
        add(fmt::format("{}_texels", name), "texels", "", of(&BiasLength::texels));
    }
    add("shadow_amount", "px", "both amounts, and softening, with the recommended bias",
        [](const Recommendation& r) { return r.outcome.amounts.shadow; });
    add("light_amount", "px", "", [](const Recommendation& r) { return r.outcome.amounts.light; });
    add("softening", "px", "", [](const Recommendation& r) { return r.outcome.softening; });
    metrics.push_back({MetricDescription{"bias_curve.recommended.views",
                                         MetricType::count,
                                         "",
                                         "number of views it was derived from",
                                         {}},
                       [](const CurveResult& curve) {
                           return curve.recommended
                                      ? MetricValue{std::uint64_t{curve.recommended->views}}
                                      : none;
                       }});
}

/// Finds the limits that four metrics are about.
using FindLimits = std::function<const BiasLimits&(const BiasBounds&)>;

void add_limits(CurveMetrics& metrics, const std::string& prefix,
                const std::array<const char*, 4>& meanings, const FindLimits& find)
{
    const auto add = [&](const char* name, const char* meaning, Worse worse,
                         float BiasLimits::*member) {
        metrics.push_back({measured(prefix + name, "depth units", meaning, worse),
                           [find, member](const CurveResult& curve) {
                               return curve.bounds ? finite(find(*curve.bounds).*member) : none;
                           }});
    };
    add("acne_free", meanings[0], Worse::up, &BiasLimits::acne_free);
    add("acne_free_count", meanings[1], Worse::up, &BiasLimits::acne_free_count);
    add("panning_free", meanings[2], Worse::down, &BiasLimits::panning_free);
    add("panning_free_beyond_zero", meanings[3], Worse::down,
        &BiasLimits::panning_free_beyond_zero);
}

void add_allowances(CurveMetrics& metrics)
{
    static constexpr std::array<const char*, 3> meanings{
        "0.0001: the same four with that share of the scored pixels allowed to be wrong", "0.001",
        "0.01"};
    for (std::size_t i = 0; i < meanings.size(); ++i) {
        const std::string prefix = fmt::format("bias_curve.allowances.{}.", i);
        metrics.push_back(
            {MetricDescription{prefix + "allowance", MetricType::number, "", meanings.at(i), {}},
             [i](const CurveResult& curve) {
                 return curve.bounds ? MetricValue{curve.bounds->allowances.at(i).allowance} : none;
             }});
        add_limits(
            metrics, prefix, {"", "", "", ""},
            [i](const BiasBounds& bounds) -> const BiasLimits& { return bounds.allowances.at(i); });
    }
}

} // namespace

CurveMetrics describe_map_metrics()
{
    return {{measured("map_near_m", "m", "near plane of the shadow map, as fitted", Worse::both),
             [](const CurveResult& curve) { return number(curve.near_m); }},
            {measured("map_far_m", "m", "far plane", Worse::both),
             [](const CurveResult& curve) { return number(curve.far_m); }},
            {MetricDescription{"map_bytes", MetricType::count, "bytes", "memory of the shadow map",
                               Worse::up},
             [](const CurveResult& curve) {
                 return curve.map_bytes ? MetricValue{*curve.map_bytes} : none;
             }}};
}

ConfigurationMetrics describe_configuration_metrics()
{
    ConfigurationMetrics all;
    add_classes(all);
    add_reasons(all);
    add_errors(all);
    add_causes(all);
    add_cause_amounts(all);
    add_gaps(all);
    return all;
}

CurveMetrics describe_curve_metrics()
{
    CurveMetrics all;
    add_best(all);
    add_limits(all, "bias_curve.",
               {"the smallest bias with which no tap of a lit pixel is shadowed by its "
                "self-shadowing surface",
                "the smallest bias with which no pixel is called acne: by side of one half",
                "the largest bias below every blocked pixel's critical bias",
                "the largest that adds no new false light to what is false lit without any bias"},
               [](const BiasBounds& bounds) -> const BiasLimits& { return bounds.strict; });
    add_allowances(all);
    add_recommended(all);
    all.push_back({MetricDescription{"bias_curve.no_constant_bias_serves",
                                     MetricType::flag,
                                     "",
                                     "at 0.1 %, acne needs more bias than panning allows",
                                     {}},
                   [](const CurveResult& curve) {
                       return curve.bounds ? MetricValue{curve.bounds->no_constant_bias_serves}
                                           : none;
                   }});
    return all;
}

} // namespace gnomon::analysis
