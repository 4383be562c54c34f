#include "analysis/results/metric_parts.hpp"
#include "analysis/results/metric_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::analysis {

namespace {

using metric_parts::finite;
using metric_parts::measured;
using metric_parts::none;
using metric_parts::number;
using metric_parts::outcome;
using metric_parts::pixel_count;
using metric_parts::titled;
using scene::ClassReason;
using scene::PixelClass;

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

SubsetCounts counts_of(const Metrics& of)
{
    return {of.pixels.of(PixelClass::lit),
            of.pixels.of(PixelClass::blocked),
            of.false_shadow,
            of.false_lit,
            of.amounts.shadow,
            of.amounts.light};
}

void add_rates(ConfigurationMetrics& metrics, bool are_outcomes)
{
    for (const SubsetRate& rate : subset_rates()) {
        if (rate.is_outcome == are_outcomes) {
            metrics.push_back({{.name = std::string{rate.name},
                                .meaning = std::string{rate.meaning},
                                .worse = Worse::up,
                                .title = rate.title,
                                .is_outcome = are_outcomes,
                                .table_note = rate.table_note},
                               [&rate](const ConfigurationResult& result) {
                                   return number(rate_of(rate, counts_of(result.metrics)));
                               }});
        }
    }
}

void add_error_sums(ConfigurationMetrics& metrics)
{
    for (const ErrorSum& sum : error_sums) {
        metrics.push_back(
            {{.name = std::string{sum.name},
              .type = sum.is_count() ? MetricType::count : MetricType::number,
              .unit = "px",
              .meaning = std::string{sum.meaning},
              .worse = Worse::up,
              .title = sum.title,
              .table_note = sum.table_note},
             [&sum](const ConfigurationResult& result) {
                 return std::visit(
                     [&](auto member) { return MetricValue{result.metrics.amounts.*member}; },
                     sum.member);
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
    add_rates(metrics, true);
    add(outcome(measured("shadow_amount", "px",
                         "[amount](errors.md#amounts) of false shadow: Σ (1 − verdict) over lit "
                         "pixels"),
                "amount of false shadow [pixels]"),
        [](const Metrics& of) { return MetricValue{of.amounts.shadow}; });
    add(outcome(
            measured("light_amount", "px", "amount of false light: Σ verdict over blocked pixels"),
            "amount of false light [pixels]"),
        [](const Metrics& of) { return MetricValue{of.amounts.light}; });
    add_rates(metrics, false);
    add_error_sums(metrics);
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
                                   "pixels that have a gap: those of `labels.peter_panning` that a "
                                   "face which the culling leaves should have shadowed"),
                       [](const ConfigurationResult& result) {
                           const auto& gaps = result.peter_panning.metres;
                           return result.causes ? MetricValue{gaps ? std::uint64_t{gaps->count} : 0}
                                                : none;
                       }});
}

} // namespace

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

} // namespace gnomon::analysis
