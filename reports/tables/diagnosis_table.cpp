#include "reports/tables/comparison_parts.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/metrics/map_results.hpp"
#include "reports/tables/table_lines.hpp"
#include "reports/text/description.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

/// Wrong pixels by name, without the first name, "none".
std::string named_counts(std::string_view head, std::span<const std::string_view> names,
                         std::span<const std::uint64_t> counts, std::uint64_t wrong)
{
    std::string text = count_line(head, "pixels", "of wrong", "");
    for (std::size_t i = 1; i < names.size(); ++i) {
        std::optional<double> share;
        if (wrong > 0) {
            share = static_cast<double>(counts[i]) / static_cast<double>(wrong);
        }
        text += count_line(shown_name(names[i]), grouped(counts[i]), percent(share), "");
    }
    return text;
}

/// Counts and amounts by name, for fractional verdicts.
std::string named_amounts(std::string_view head, std::span<const std::string_view> names,
                          std::span<const std::uint64_t> counts, std::span<const double> amounts)
{
    std::string text = count_line(head, "wrong px", "amount px", "");
    for (std::size_t i = 1; i < names.size(); ++i) {
        text +=
            count_line(shown_name(names[i]), grouped(counts[i]), grouped_amount(amounts[i]), "");
    }
    return text;
}

/// "bias 0.06 m, 1.2 texels, slope 0.1 m, offset 0.05 m"; slope and offset only if not 0.
std::string bias_text(const analysis::MapBias& bias, std::string_view unit)
{
    std::string text =
        fmt::format("bias {:.3g} {}, {:.3g} texels", bias.constant_m, unit, bias.constant_texels);
    if (bias.slope_m != 0) {
        text += fmt::format(", slope {:.3g} {}", bias.slope_m, unit);
    }
    if (bias.normal_offset_m != 0) {
        text += fmt::format(", offset {:.3g} {}", bias.normal_offset_m, unit);
    }
    return text;
}

/// Each cascade's range and biases; empty without cascades.
std::string cascade_table(const analysis::Comparison& comparison)
{
    const std::string_view unit = length_unit(comparison);
    std::string text;
    for (std::size_t i = 0; i < comparison.view.maps.size(); ++i) {
        const analysis::MapFacts map = analysis::facts_of_map(comparison.job, comparison.view, i);
        if (!map.bias) {
            return "";
        }
        const analysis::SubsetCounts& readers = comparison.diagnosis->by_map.at(i).counts;
        if (readers.lit + readers.blocked == 0) {
            text += setting_line(i == 0 ? "cascades" : "",
                                 fmt::format("{}: view depth {:.4g} to {:.4g} {}; no scored pixel "
                                             "reads it",
                                             map.name, *map.begin_m, *map.end_m, unit));
            continue;
        }
        text +=
            setting_line(i == 0 ? "cascades" : "",
                         fmt::format("{0}: view depth {2:.4g} to {3:.4g} {1}, texel {4:.3g} {1}, "
                                     "range {5:.4g} {1}; {6}",
                                     map.name, unit, *map.begin_m, *map.end_m, map.texel_m,
                                     map.far_m - map.near_m, bias_text(*map.bias, unit)));
    }
    return fmt::format("\n{}", text);
}

/// Errors by map, one per line; empty for a single map.
std::string map_table(const analysis::Comparison& comparison)
{
    const auto& maps = comparison.diagnosis->by_map;
    if (maps.empty()) {
        return "";
    }
    std::string text = "\n";
    text += count_line("in map", "false shadow", "false lit", "of scored");
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const analysis::SubsetCounts& counts = maps[i].counts;
        text += count_line(comparison.view.map_name(i), grouped(counts.false_shadow),
                           grouped(counts.false_lit), grouped(counts.lit + counts.blocked));
    }
    return text + cascade_table(comparison);
}

std::string causes(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return "";
    }
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    std::string text = "\n";
    const analysis::CauseCounts& counts = diagnosis.causes.counts;
    const analysis::CauseAmounts& amounts = diagnosis.causes.amounts;
    if (analysis::has_fractions(comparison.metrics)) {
        text += named_amounts("cause", analysis::cause_names, counts.by_cause, amounts.by_cause);
        text += "\n";
        text += named_amounts("called", analysis::label_names, counts.by_label, amounts.by_label);
        text += setting_line("", fmt::format("softened borders (edge by filter): {} px",
                                             grouped_amount(amounts.softening())));
    } else {
        text += named_counts("cause", analysis::cause_names, counts.by_cause, wrong);
        text += "\n";
        text += named_counts("called", analysis::label_names, counts.by_label, wrong);
    }
    if (const auto& kinds = comparison.precision_kinds;
        kinds && kinds->format + kinds->transform > 0) {
        text += setting_line("", fmt::format("precision: {} by the format, {} by transforms",
                                             grouped(kinds->format), grouped(kinds->transform)));
    }
    const auto& [gap, gap_texels] = diagnosis.peter_panning;
    if (gap && gap_texels) {
        text += setting_line(
            "", fmt::format("peter-panning gap of {0}: median {2:.4g} {1}, 95 % {3:.4g} {1}, "
                            "largest {4:.4g} {1} ({5:.3g} texels)",
                            counted(gap->count, "pixel"), length_unit(comparison), gap->median,
                            gap->p95, gap->max, gap_texels->max));
    }
    return text + object_table(diagnosis.by_object) + map_table(comparison);
}

std::string limit(float bias, std::string_view none)
{
    return std::isfinite(bias) ? fmt::format("{:.4g}", plain_zero(bias)) : std::string{none};
}

/// "no acne from 0.0024 (by count from 0.0008)"; the count only if it differs.
std::string no_acne(const analysis::BiasLimits& limits)
{
    if (!std::isfinite(limits.acne_free)) {
        return limits.acne_free < 0 ? "no acne with any bias" : "acne with every bias";
    }
    std::string text = fmt::format("no acne from {}", limit(limits.acne_free, "-"));
    if (limits.acne_free != limits.acne_free_count) {
        const float count = limits.acne_free_count;
        text += std::isfinite(count) ? fmt::format(" (by count from {})", limit(count, "-"))
                : count < 0          ? " (by count with any bias)"
                                     : " (by count with none)";
    }
    return text;
}

std::string no_false_light(const analysis::BiasLimits& limits)
{
    if (!std::isfinite(limits.panning_free)) {
        return limits.panning_free > 0 ? "no false light with any bias"
                                       : "false light with every bias";
    }
    return fmt::format("no false light up to {}", limit(limits.panning_free, "-"));
}

/// "no peter-panning up to 0.02; 359 blocked pixels are lit at 0 already, for other reasons"
std::string no_peter_panning(const analysis::CurveResult& curve)
{
    if (!curve.peter_panning) {
        return "no peter-panning up to -";
    }
    const auto& [free, lit_at_zero] = *curve.peter_panning;
    std::string text = "no peter-panning with any bias";
    if (free < 0 && std::isinf(free)) {
        text = "peter-panning with every bias";
    } else if (std::isfinite(free)) {
        text = fmt::format("no peter-panning up to {}", limit(free, "-"));
    }
    return lit_at_zero > 0
               ? fmt::format("{}; {} {} lit at 0 already, for other reasons", text,
                             counted(lit_at_zero, "blocked pixel"), lit_at_zero == 1 ? "is" : "are")
               : text;
}

std::string verification(const analysis::Comparison& comparison)
{
    return comparison.verification ? setting_line("", verification_text(*comparison.verification))
                                   : std::string{};
}

/// "recommended 0.029 (0.21 m, 3 texels)", then `bias_sentences`, one per line; empty if no bias is
/// recommended.
std::string recommended_lines(const analysis::Comparison& comparison)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    if (!recommended) {
        return {};
    }
    if (!analysis::keeps_shadows(comparison, recommended->rounded_outcome)) {
        return setting_line("", "none is recommended: the fewest errors are where most shadows are "
                                "lit; the map is too coarse, or its kernel too wide");
    }
    const analysis::BiasLength& bias = recommended->rounded_length;
    std::string text = setting_line(
        "", fmt::format(
                "recommended {:.4g} ({:.3g} {}, {:.3g} texels{}){}", bias.depth, bias.metres,
                length_unit(comparison), bias.texels, map_of_lengths(comparison),
                recommended->views > 1 ? fmt::format(", over {} views", recommended->views) : ""));
    for (const std::string& sentence :
         bias_sentences({bias, recommended->low, recommended->high, recommended->margin,
                         length_unit(comparison)})) {
        text += setting_line("", sentence);
    }
    return text;
}

/// "fewest errors (12) from 0.002 to 0.003"; an infinite end is left out.
std::string fewest_errors(const analysis::BestBiases& best)
{
    const auto& [lo, hi] = best.interval;
    std::string text = fmt::format("fewest errors ({})", grouped(best.errors.total()));
    if (!std::isfinite(lo) && !std::isfinite(hi)) {
        return text + " with any bias";
    }
    if (!std::isfinite(lo)) {
        return text + fmt::format(" with {:.4g} or less", plain_zero(hi));
    }
    return text + (std::isfinite(hi)
                       ? fmt::format(" from {:.4g} to {:.4g}", plain_zero(lo), plain_zero(hi))
                       : fmt::format(" with {:.4g} or more", plain_zero(lo)));
}

std::string constant_bias(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis || !comparison.diagnosis->biases ||
        comparison.metrics.pixels.scored() == 0) {
        return "";
    }
    const analysis::BiasAnswers& answers = *comparison.diagnosis->biases;
    const analysis::BiasLimits& lenient = answers.bounds.allowances[1];
    std::string text = "\n";
    text += setting_line("constant bias", fewest_errors(answers.best));
    text += setting_line("", fmt::format("{}, {}", no_acne(answers.bounds.strict),
                                         no_peter_panning(comparison.diagnosis->curve)));
    text += setting_line("", fmt::format("but for 0.1 % of the pixels: {}, {}", no_acne(lenient),
                                         no_false_light(lenient)));
    return text + recommended_lines(comparison) + verification(comparison);
}

} // namespace

std::string object_table(const std::vector<analysis::ObjectErrors>& objects)
{
    constexpr std::size_t most_lines = 12;
    std::vector<analysis::ObjectErrors> wrong;
    std::ranges::copy_if(objects, std::back_inserter(wrong), [](const auto& object) {
        return object.counts.false_shadow + object.counts.false_lit > 0;
    });
    if (objects.size() < 2 || wrong.empty()) {
        return "";
    }
    std::ranges::stable_sort(wrong, std::greater{}, [](const analysis::ObjectErrors& object) {
        return object.counts.false_shadow + object.counts.false_lit;
    });
    std::string text = "\n";
    text += count_line("on object", "false shadow", "false lit", "");
    for (std::size_t i = 0; i < std::min(wrong.size(), most_lines); ++i) {
        text += count_line(wrong[i].name, grouped(wrong[i].counts.false_shadow),
                           grouped(wrong[i].counts.false_lit), "");
    }
    if (wrong.size() > most_lines) {
        text += setting_line("", fmt::format("and on {} more", wrong.size() - most_lines));
    }
    return text;
}

std::string diagnosis_table(const analysis::Comparison& comparison)
{
    return causes(comparison) + constant_bias(comparison) + remedy_table(comparison);
}

std::string findings_text(const analysis::Comparison& comparison)
{
    std::string text;
    for (const std::string& sentence : findings(comparison)) {
        text += sentence + "\n";
    }
    return text.empty() ? text : "\n" + text;
}

} // namespace gnomon::reports
