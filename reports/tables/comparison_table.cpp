#include "reports/tables/comparison_table.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/pixels/statistics.hpp"
#include "analysis/results/metric_table.hpp"
#include "analysis/results/results.hpp"
#include "reports/tables/comparison_parts.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::reports {

namespace {

using analysis::MetricValue;
using scene::ClassReason;
using scene::PixelClass;

/// "5 of 1,234 signs needed integers"; empty if the method decides no signs.
std::string signs(const scene::TruthSigns& signs)
{
    const std::uint64_t all = signs.filtered + signs.exact;
    return all == 0 ? std::string{}
                    : setting_line("", fmt::format("{} of {} signs needed integers",
                                                   grouped(signs.exact), grouped(all)));
}

/// "factor 2: 0.0026, 0.262 m, 6.61 texels; 95 % up to 1.12 m", at the median pixel.
std::string length_text(std::string_view of, const analysis::OffsetLengths& lengths,
                        std::string_view unit)
{
    return fmt::format("{}: {:.3g}, {:.3g} {}, {:.3g} texels; 95 % up to {:.3g} {}", of,
                       lengths.depth.median, lengths.metres.median, unit, lengths.texels.median,
                       lengths.metres.p95, unit);
}

/// The job's polygon offset at its pixels; factor and units only if not 0.
std::string offset_lines(const analysis::DrawnOffset& drawn, std::string_view unit)
{
    const methods::PolygonOffset& offset = drawn.offset;
    std::string text;
    const auto add = [&text](const std::string& words) {
        text += setting_line(text.empty() ? "polygon offset" : "", words);
    };
    if (offset.factor != 0) {
        add(length_text(fmt::format("factor {:.4g}", offset.factor), drawn.of_factor, unit));
    }
    if (offset.units != 0) {
        add(length_text(fmt::format("units {:.4g} of r {:.3g}", offset.units, drawn.r.median),
                        drawn.of_units, unit));
    }
    if (offset.factor != 0 && offset.units != 0) {
        add(length_text("both", drawn.whole, unit));
    }
    return text;
}

std::string settings(const analysis::Comparison& comparison)
{
    if (comparison.evaluation) {
        return evaluation_settings(comparison, *comparison.evaluation) +
               signs(comparison.truth.signs);
    }
    const Description words = describe(comparison);
    const analysis::Environment& environment = comparison.environment;
    std::string text = setting_line("scene", comparison.scene.name);
    text += setting_line("", words.size);
    text += note_lines(comparison.scene.notes);
    text += setting_line("image", words.image);
    text += setting_line("light", words.light);
    text += setting_line("shadow map", words.map);
    text += words.range.empty() ? "" : setting_line("", words.range);
    text += setting_line("lookup", words.lookup);
    text += setting_line("bias", words.bias);
    text += comparison.drawn_offset
                ? offset_lines(*comparison.drawn_offset, length_unit(comparison))
                : "";
    text += setting_line("GL", environment.gl_renderer);
    text += setting_line("", environment.gl_version);
    text +=
        setting_line("truth", fmt::format("{}, {}", comparison.truth_method, environment.embree));
    text += signs(comparison.truth.signs);
    return text;
}

/// "snap 3, tie 1"; only reasons that occur.
std::string reasons(const analysis::ClassCounts& counts,
                    std::initializer_list<std::pair<ClassReason, std::string_view>> named)
{
    std::string text;
    for (const auto& [reason, name] : named) {
        if (counts.of(reason) > 0) {
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : ", ", name, grouped(counts.of(reason)));
        }
    }
    return text;
}

std::string class_note(const analysis::ClassCounts& counts, PixelClass pixel_class)
{
    if (pixel_class == PixelClass::unmatched) {
        return reasons(counts, {{ClassReason::snap, "snap"},
                                {ClassReason::tie, "tie"},
                                {ClassReason::mismatch, "mismatch"}});
    }
    if (pixel_class == PixelClass::indeterminate) {
        return reasons(counts, {{ClassReason::silhouette, "silhouette"},
                                {ClassReason::vertex, "vertex"},
                                {ClassReason::graze, "graze"},
                                {ClassReason::rounding, "rounding"}});
    }
    return scene::is_scored(pixel_class) ? "scored" : "";
}

std::string classes(const analysis::ClassCounts& counts)
{
    std::string text = count_line("class", "pixels", "share", "");
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        const auto pixel_class = static_cast<PixelClass>(i);
        const std::uint64_t count = counts.of(pixel_class);
        std::optional<double> share;
        if (counts.total > 0) {
            share = static_cast<double>(count) / static_cast<double>(counts.total);
        }
        text += count_line(scene::pixel_class_names[i], grouped(count), percent(share),
                           class_note(counts, pixel_class));
    }
    return text + count_line("total", grouped(counts.total), "", "");
}

std::string noted_line(const analysis::MetricDescription& metric, const MetricValue& value)
{
    const auto line = [&](const std::string& count, const std::string& rate) {
        return count_line(shown_name(metric.name), count, rate, metric.table_note);
    };
    if (const auto* const count = std::get_if<std::uint64_t>(&value)) {
        return line(grouped(*count), "");
    }
    const auto* const number = std::get_if<double>(&value);
    if (number == nullptr) {
        return "";
    }
    return metric.adds_up() ? line(grouped_amount(*number), "") : line("", percent(*number));
}

/// The metrics with their own line.
std::string noted_lines(const analysis::Comparison& comparison)
{
    const analysis::ConfigurationResult result = analysis::result_of(comparison);
    const bool shows_zeros = has_fractions(comparison.metrics);
    std::string text;
    for (const auto& metric : analysis::configuration_metrics()) {
        if (metric.table_note.empty()) {
            continue;
        }
        const MetricValue value = metric.value(result);
        const bool is_zero =
            value == MetricValue{std::uint64_t{0}} || value == MetricValue{double{0}};
        text += is_zero && !shows_zeros ? "" : noted_line(metric, value);
    }
    return text;
}

std::string errors(const analysis::Comparison& comparison)
{
    const analysis::Metrics& metrics = comparison.metrics;
    const analysis::ClassCounts& counts = metrics.pixels;
    const auto denominator = [](std::uint64_t count, std::string_view noun) {
        return fmt::format("of {} {}", grouped(count), noun);
    };
    std::string text = count_line("error", "pixels", "rate", "");
    text += count_line("false shadow", grouped(metrics.false_shadow),
                       percent(metrics.false_shadow_rate),
                       denominator(counts.of(PixelClass::lit), "lit"));
    text += count_line("false lit", grouped(metrics.false_lit), percent(metrics.false_lit_rate),
                       denominator(counts.of(PixelClass::blocked), "blocked"));
    text += count_line("both", grouped(metrics.false_shadow + metrics.false_lit),
                       percent(metrics.error_rate), denominator(counts.scored(), "scored"));
    if (!has_fractions(metrics)) {
        return text + noted_lines(comparison);
    }
    text += count_line("amount", "pixels", "rate", "");
    text += count_line("false shadow", grouped_amount(metrics.amounts.shadow),
                       percent(metrics.shadow_amount_rate), "dark where lit");
    text += count_line("false light", grouped_amount(metrics.amounts.light),
                       percent(metrics.light_amount_rate), "lit where blocked");
    text += count_line("both", grouped_amount(metrics.amounts.total()),
                       percent(metrics.mean_abs_error), "mean |verdict - truth|");
    if (comparison.diagnosis) {
        const double error = analysis::error_amount(comparison);
        text += count_line("unsoftened", grouped_amount(error),
                           percent(analysis::ratio(error, counts.scored())),
                           "both, without borders softened on purpose");
    }
    return text + noted_lines(comparison);
}

std::string float_audit(const analysis::Comparison& comparison)
{
    if (comparison.float_audit.empty()) {
        return "";
    }
    std::string text = "\n";
    text += count_line("float method", "false blocked", "false lit", "");
    for (const scene::FloatMethodErrors& method : comparison.float_audit) {
        text += count_line(method.name, grouped(method.false_blocked), grouped(method.false_lit),
                           "wrong pixels");
    }
    return text;
}

std::string seconds_line(const analysis::StageSeconds& seconds)
{
    return setting_line("seconds",
                        fmt::format("scene {:.3f}  bvh {:.3f}  receivers {:.3f}  shadow map {:.3f}",
                                    seconds.scene, seconds.bvh, seconds.receivers,
                                    seconds.shadow_map)) +
           setting_line("", fmt::format("lookup {:.3f}  truth {:.3f}  analysis {:.3f}",
                                        seconds.lookup, seconds.truth, seconds.analysis));
}

} // namespace

std::string comparison_table(const analysis::Comparison& comparison)
{
    if (comparison.evaluation) {
        return fmt::format(
            "{}\n{}\n{}{}{}{}", settings(comparison), classes(comparison.metrics.pixels),
            errors(comparison), diagnosis_table(comparison),
            evaluation_table(comparison, *comparison.evaluation), findings_text(comparison));
    }
    return fmt::format("{}\n{}\n{}{}{}\n{}", settings(comparison),
                       classes(comparison.metrics.pixels), errors(comparison),
                       diagnosis_table(comparison), float_audit(comparison),
                       seconds_line(comparison.seconds) + findings_text(comparison));
}

namespace {

constexpr std::size_t light_columns = 24;
constexpr std::size_t number_columns = 14;
constexpr std::size_t share_columns = 12;

std::string line(std::string_view name, std::string_view scored, std::string_view shadow,
                 std::string_view light, std::string_view rate)
{
    return pad_right(name, light_columns) + pad_left(scored, number_columns) +
           pad_left(shadow, number_columns) + pad_left(light, number_columns) +
           pad_left(rate, share_columns) + "\n";
}

std::string error_line(const std::string& name, const analysis::Metrics& metrics)
{
    return line(name, grouped(metrics.pixels.scored()), grouped(metrics.false_shadow),
                grouped(metrics.false_lit), percent(metrics.error_rate));
}

std::string amount_line(const std::string& name, const analysis::Metrics& metrics)
{
    return line(name, "", grouped_amount(metrics.amounts.shadow),
                grouped_amount(metrics.amounts.light), percent(metrics.mean_abs_error));
}

/// One line per light, and one for all together.
template <typename Line>
std::string lines(std::span<const analysis::Comparison> lights, const analysis::Metrics& total,
                  Line&& line_of)
{
    std::string text;
    for (const analysis::Comparison& comparison : lights) {
        text += line_of(comparison.light, comparison.metrics);
    }
    return text + line_of("all lights", total);
}

} // namespace

std::string lights_table(std::span<const analysis::Comparison> lights)
{
    std::string text;
    for (const analysis::Comparison& comparison : lights) {
        text += heading_line("light " + comparison.light) + comparison_table(comparison) + "\n";
    }
    const analysis::Metrics total = analysis::total_of(analysis::results_of(lights)).metrics;
    text += heading_line("totals");
    text += line("light", "scored", "false shadow", "false lit", "rate");
    text += lines(lights, total, error_line);
    const auto has_fractions = [](const analysis::Comparison& comparison) {
        return analysis::has_fractions(comparison.metrics);
    };
    if (std::ranges::any_of(lights, has_fractions)) {
        text += line("amount [px]", "", "false shadow", "false light", "mean");
        text += lines(lights, total, amount_line);
    }
    return text;
}

} // namespace gnomon::reports
