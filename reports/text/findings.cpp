#include "reports/text/findings.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/advice/remedies.hpp"
#include "analysis/metrics/map_results.hpp"
#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/error_text.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::BiasLength;
using analysis::Margin;
using analysis::Recommendation;

/// Share of the picture's height from which a gap between caster and shadow is visible.
constexpr double long_share = 0.05;

/// "0.021 (0.58 m)"
std::string with_length(const BiasLength& bias, std::string_view unit)
{
    return fmt::format("{:.4g} ({:.3g} {})", bias.depth, bias.metres, unit);
}

/// "0.021 (0.58 m) to 0.04 (1.1 m)"; other words if an end is 0 or infinite.
std::string broad_minimum(const RecommendedLengths& recommended)
{
    const bool has_end = std::isfinite(recommended.high.depth);
    if (recommended.low.depth == 0) {
        return has_end
                   ? fmt::format("all up to {}", with_length(recommended.high, recommended.unit))
                   : "all others";
    }
    return has_end ? fmt::format("{} to {}", with_length(recommended.low, recommended.unit),
                                 with_length(recommended.high, recommended.unit))
                   : fmt::format("all from {} on", with_length(recommended.low, recommended.unit));
}

bool is_within(const RecommendedLengths& recommended)
{
    return recommended.low.depth <= recommended.bias.depth &&
           recommended.bias.depth <= recommended.high.depth;
}

std::string place_in_minimum(const RecommendedLengths& recommended)
{
    const std::string others =
        fmt::format("{} are nearly as good here", broad_minimum(recommended));
    switch (recommended.margin) {
    case Margin::not_needed:
        return fmt::format("No constant bias is needed; {}.", others);
    case Margin::whole:
        return fmt::format("It is the smallest with three texels to spare; {}.", others);
    case Margin::cut_short:
        return fmt::format("It is in the middle, with less than three texels to spare; {}.",
                           others);
    case Margin::within_limits:
        return is_within(recommended)
                   ? fmt::format("It is the nearest to the recommended one that meets the limits; "
                                 "{}.",
                                 others)
                   : fmt::format("It is the smallest that meets the limits; {} would leave less "
                                 "error, and not meet them.",
                                 broad_minimum(recommended));
    }
    return {};
}

/// The picture's height at the camera's target [m]; empty if unknown.
std::optional<double> picture_height_m(const analysis::Comparison& comparison)
{
    const scene::Camera& camera = comparison.view.camera;
    if (camera.projection == scene::Projection::orthographic) {
        return 2 * camera.half_height;
    }
    return comparison.target_distance_m > 0
               ? std::optional{2 * camera.half_height * comparison.target_distance_m}
               : std::nullopt;
}

bool leaves_no_more(const Recommendation& other, const Recommendation& own)
{
    return other.rounded_outcome.error_amount() <= own.rounded_outcome.error_amount() &&
           other.rounded_length.metres < own.rounded_length.metres;
}

/// The slope bias that allows the smallest constant bias without more error; may be null. Slopes
/// are known only for a single view.
const analysis::SlopeAnswer* gentler_slope(const analysis::Comparison& comparison,
                                           const Recommendation& own)
{
    const analysis::SlopeAnswer* best = nullptr;
    if (!comparison.diagnosis->biases || own.views > 1) {
        return best;
    }
    for (const analysis::SlopeAnswer& answer : comparison.diagnosis->biases->slopes) {
        const bool is_gentler =
            answer.recommended && answer.slope != comparison.view.bias.slope &&
            leaves_no_more(*answer.recommended, own) &&
            analysis::keeps_shadows(comparison, answer.recommended->rounded_outcome);
        if (is_gentler && (best == nullptr || answer.recommended->rounded_length.metres <
                                                  best->recommended->rounded_length.metres)) {
            best = &answer;
        }
    }
    return best;
}

} // namespace

std::vector<std::string> bias_sentences(const RecommendedLengths& recommended)
{
    return {place_in_minimum(recommended),
            recommended.bias.depth == 0
                ? std::string{"A constant bias of 0 takes no caster's shadow away."}
                : caster_sentence(recommended.bias, recommended.unit)};
}

std::string caster_sentence(const analysis::BiasLength& bias, std::string_view unit)
{
    return fmt::format("A caster whose lit side is nearer than {:.3g} {} to a surface, along the "
                       "light's axis, casts no shadow there.",
                       bias.metres, unit);
}

std::optional<std::string> long_bias(const analysis::Comparison& comparison, bool names_slope)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    const auto height_m = picture_height_m(comparison);
    if (!recommended || !height_m ||
        !(recommended->rounded_length.metres > long_share * *height_m)) {
        return std::nullopt;
    }
    const double length_m = recommended->rounded_length.metres;
    const std::string_view unit = length_unit(comparison);
    std::string text = fmt::format("The recommended constant bias of {:.3g} {} is long: {} of "
                                   "the picture's height at the camera's target",
                                   length_m, unit, percent(length_m / *height_m));
    const analysis::SlopeAnswer* const slope =
        names_slope ? gentler_slope(comparison, *recommended) : nullptr;
    if (slope != nullptr) {
        const Recommendation& other = *slope->recommended;
        text += fmt::format("; bias.slope = {} with {} ({:.3g} {}) leaves no more error",
                            slope->slope, other.rounded.key, other.rounded_length.metres, unit);
    }
    return text + ".";
}

std::vector<std::string> recommendation_sentences(const analysis::Comparison& comparison)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    if (!recommended) {
        return {};
    }
    if (!analysis::keeps_shadows(comparison, recommended->rounded_outcome)) {
        return {"It lights over half of what is in shadow: the map is too coarse, or its kernel "
                "too wide."};
    }
    auto sentences =
        bias_sentences({recommended->rounded_length, recommended->low, recommended->high,
                        recommended->margin, length_unit(comparison)});
    if (const auto is_long = long_bias(comparison)) {
        sentences.push_back(*is_long);
    }
    return sentences;
}

namespace {

void append(std::vector<std::string>& sentences, std::string sentence)
{
    if (!sentence.empty()) {
        sentences.push_back(std::move(sentence));
    }
}

/// Whether `--advise` could measure changes: only for Gnomon's own maps.
bool can_advise(const analysis::Comparison& comparison)
{
    return comparison.advice.empty() && !comparison.evaluation &&
           methods::traits(comparison.job).has_map;
}

/// That the job's other biases may cause errors that the remedy leaves; empty if they were
/// measured, or if there are none.
std::string other_biases_at_fault(const analysis::Comparison& comparison)
{
    const std::string other = bias_or_map_hint(comparison);
    return can_advise(comparison) && !other.empty()
               ? fmt::format(
                     "{}, which may be at fault: `--advise` measures what is left without it.",
                     other)
               : "";
}

/// "No scored pixel reads cascade 0, from 0.1 to 0.84 m."; empty if each is read.
std::string unread_cascades(const analysis::Comparison& comparison)
{
    const auto& maps = comparison.diagnosis->by_map;
    std::vector<std::string> unread;
    for (std::size_t i = 0; i < maps.size() && !comparison.view.slices.ends.empty(); ++i) {
        if (maps[i].counts.lit + maps[i].counts.blocked == 0) {
            const analysis::MapFacts map =
                analysis::facts_of_map(comparison.job, comparison.view, i);
            unread.push_back(fmt::format("cascade {}, from {:.4g} to {:.4g} {}", map.name,
                                         *map.begin_m, *map.end_m, length_unit(comparison)));
        }
    }
    return unread.empty() ? ""
                          : fmt::format("No scored pixel reads {}.", fmt::join(unread, "; nor "));
}

/// `long_bias` if the first remedy is the recommended bias; else empty.
std::string length_warning(const analysis::Comparison& comparison,
                           const std::vector<analysis::Remedy>& remedies, bool names_slope)
{
    return recommends_constant_bias(comparison, remedies)
               ? long_bias(comparison, names_slope).value_or("")
               : "";
}

} // namespace

bool has_errors(const analysis::Comparison& comparison)
{
    return sum_of(analysis::named_errors(comparison).by_label) > 0;
}

bool recommends_constant_bias(const analysis::Comparison& comparison,
                              const std::vector<analysis::Remedy>& remedies)
{
    const auto& recommended = comparison.diagnosis->curve.recommended;
    return recommended && !remedies.empty() &&
           remedies.front().keys == std::vector{recommended->rounded.key};
}

std::string hint_sentence(const analysis::Comparison& comparison)
{
    if (const auto trades = analysis::trade_offs(comparison); !trades.empty()) {
        const std::string_view known =
            can_advise(comparison) ? "No bias lessens wrong pixels and amounts alike; "
                                     "`--advise` measures other changes."
                                   : "No known change lessens wrong pixels and amounts alike.";
        return fmt::format("{} {}", known, remedy_sentence(comparison, trades.front()));
    }
    if (!comparison.advice.empty()) {
        return fmt::format("None of {} leaves less.",
                           counted(comparison.advice.size(), "measured change"));
    }
    const std::string other = bias_or_map_hint(comparison);
    std::string text = other.empty() ? "" : other + ".";
    if (!can_advise(comparison)) {
        return text;
    }
    return fmt::format("{}{}`--advise` measures what cures the errors.", text,
                       text.empty() ? "" : " ");
}

std::vector<std::string> warning_sentences(const analysis::Comparison& comparison,
                                           const std::vector<analysis::Remedy>& remedies)
{
    std::vector<std::string> sentences;
    append(sentences, unread_cascades(comparison));
    if (!has_errors(comparison)) {
        return sentences;
    }
    const bool lists_slope = std::ranges::any_of(remedies, [](const analysis::Remedy& remedy) {
        return remedy.keys.front().starts_with("bias.slope ");
    });
    append(sentences, length_warning(comparison, remedies, !lists_slope));
    append(sentences, remedies.empty() ? "" : other_biases_at_fault(comparison));
    append(sentences, can_advise(comparison) ? origin_hint(comparison) : "");
    append(sentences, unserved_bias_text(comparison));
    return sentences;
}

std::vector<std::string> errors_as_text(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{error_summary(comparison)};
    if (has_errors(comparison)) {
        append(sentences, cause_sentences(comparison, nullptr));
        const std::string other = bias_or_map_hint(comparison);
        append(sentences, other.empty() ? "" : other + ".");
    }
    return sentences;
}

std::vector<std::string> findings(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return {};
    }
    std::vector<std::string> sentences{error_summary(comparison)};
    if (!has_errors(comparison)) {
        return sentences;
    }
    const auto remedies = analysis::ranked_remedies(comparison);
    const analysis::Remedy* const first = remedies.empty() ? nullptr : &remedies.front();
    append(sentences,
           first != nullptr ? remedy_sentence(comparison, *first) : hint_sentence(comparison));
    append(sentences, first != nullptr ? other_biases_at_fault(comparison) : "");
    append(sentences, length_warning(comparison, remedies, true));
    append(sentences, cause_sentences(comparison, first));
    append(sentences, can_advise(comparison) ? origin_hint(comparison) : "");
    append(sentences, unserved_bias_text(comparison));
    append(sentences, unread_cascades(comparison));
    return sentences;
}

} // namespace gnomon::reports
