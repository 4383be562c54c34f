#include "reports/text/recommendation_text.hpp"

#include "analysis/advice/remedies.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gnomon::reports {

namespace {

using analysis::BiasLength;
using analysis::Margin;
using analysis::Recommendation;

/// Of the picture's height: shadows that are missing so far from their casters are seen.
constexpr double long_share = 0.05;

/// "0.021 (0.58 m)"
std::string with_length(const BiasLength& bias, std::string_view unit)
{
    return fmt::format("{:.4g} ({:.3g} {})", bias.depth, bias.metres, unit);
}

/// "0.021 (0.58 m) to 0.04 (1.1 m)", or what they are where an end is 0 or missing.
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

/// How high the picture is where the camera looks [m]; empty where that is not known.
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

/// The slope with the smallest constant bias that leaves no more error; nullptr without one. Slopes
/// are known of the job's own view alone.
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
    std::vector<std::string> sentences{place_in_minimum(recommended)};
    sentences.push_back(
        recommended.bias.depth == 0
            ? std::string{"A constant bias of 0 takes no caster's shadow away."}
            : fmt::format(
                  "A caster whose lit side is nearer than {:.3g} {} to a surface, along the "
                  "light's axis, casts no shadow there.",
                  recommended.bias.metres, recommended.unit));
    return sentences;
}

std::optional<std::string> long_bias(const analysis::Comparison& comparison)
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
    if (const analysis::SlopeAnswer* slope = gentler_slope(comparison, *recommended)) {
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

} // namespace gnomon::reports
