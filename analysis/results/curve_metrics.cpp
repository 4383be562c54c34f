#include "analysis/results/metric_parts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

using metric_parts::finite;
using metric_parts::measured;
using metric_parts::none;
using metric_parts::number;
using metric_parts::outcome;
using metric_parts::pixel_count;

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

/// The recommendation: no change of it is better or worse by itself.
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
                 "the recommended constant bias: three texels above the lower end of the lowest "
                 "broad valley of the amount of error without softening, at most the geometric "
                 "mean of its ends; in metres along the light's axis and in texels at the median "
                 "receiver",
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

/// Finds the limits of four metrics.
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

/// No change of these is better or worse by itself: they leave out pixels that are lit for other
/// reasons.
void add_peter_panning(CurveMetrics& metrics)
{
    metrics.push_back(
        {MetricDescription{"bias_curve.peter_panning_free",
                           MetricType::number,
                           "depth units",
                           "the largest bias with which no pixel is called peter-panning; without "
                           "a value where none ever is, or one always is",
                           {}},
         [](const CurveResult& curve) {
             return curve.peter_panning ? finite(curve.peter_panning->free) : none;
         }});
    metrics.push_back(
        {MetricDescription{"bias_curve.lit_at_zero",
                           MetricType::count,
                           "px",
                           "blocked pixels that are lit with a constant bias of 0 already, and are "
                           "not called peter-panning",
                           {}},
         [](const CurveResult& curve) {
             return curve.peter_panning ? MetricValue{curve.peter_panning->lit_at_zero} : none;
         }});
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
    return {
        {measured("map_near_m", "m",
                  "near plane of the shadow map, as fitted; of several the nearest", Worse::both),
         [](const CurveResult& curve) { return number(curve.near_m); }},
        {measured("map_far_m", "m", "far plane; of several the farthest", Worse::both),
         [](const CurveResult& curve) { return number(curve.far_m); }},
        {MetricDescription{"map_bytes", MetricType::count, "bytes", "memory of the shadow map",
                           Worse::up},
         [](const CurveResult& curve) {
             return curve.map_bytes ? MetricValue{*curve.map_bytes} : none;
         }}};
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
    add_peter_panning(all);
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
