#include "reports/text/error_text.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/bias/bias_units.hpp"
#include "analysis/pixels/statistics.hpp"
#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::Cause;
using scene::PixelClass;

bool has_map(const analysis::Comparison& comparison)
{
    return methods::traits(comparison.job).has_map;
}

/// The prefix for amounts; empty if all verdicts are 0 or 1.
std::string_view by_amount(const analysis::Comparison& comparison)
{
    return has_fractions(comparison.metrics) ? "By amount, " : "";
}

/// The summary if all errors are intended softening, or too small to have a cause.
std::string softened_alone(const analysis::Comparison& comparison)
{
    const analysis::Metrics& metrics = comparison.metrics;
    if (!has_fractions(metrics)) {
        return fmt::format("All {} scored pixels are right.", grouped(metrics.pixels.scored()));
    }
    return fmt::format("All {} scored pixels are right but for borders that the kernel softens on "
                       "purpose: verdicts are off by {} on average.",
                       grouped(metrics.pixels.scored()), percent(metrics.mean_abs_error));
}

/// The intended softening, if there is any.
std::string softened_too(const analysis::Comparison& comparison)
{
    const double softening = comparison.diagnosis->left_out().total();
    if (!has_fractions(comparison.metrics) || softening <= 0) {
        return "";
    }
    return fmt::format(" Borders that the kernel softens on purpose are left out of this; they are "
                       "{} of the surface.",
                       percent(analysis::ratio(softening, comparison.metrics.pixels.scored())));
}

/// Light distances of the scored receivers [m]; empty without a map.
std::optional<analysis::Quantiles> distances_m(const analysis::Comparison& comparison)
{
    if (comparison.view.maps.empty()) {
        return std::nullopt;
    }
    const auto& light_distance_m = comparison.diagnosis->light_distance_m;
    return analysis::find_quantiles(
        std::vector<float>(light_distance_m.begin(), light_distance_m.end()));
}

/// ", whose step is 0.34 m at the median receiver"
std::string step_at_median(const analysis::Comparison& comparison)
{
    const auto light_distance_m = distances_m(comparison);
    return light_distance_m
               ? fmt::format(", whose step is {:.2g} {} at the median receiver",
                             analysis::depth_step_length_m(comparison.view.first_map(),
                                                           comparison.job.shadow_map.depth_format,
                                                           double{light_distance_m->median}),
                             length_unit(comparison))
               : "";
}

/// That near and far leave too few depths for float32 transforms to distinguish the receivers, in
/// any format; empty if they are fine.
std::string blind_depths(const analysis::Comparison& comparison)
{
    constexpr double too_long = 0.05; // of the receivers' range: at most twenty depths
    constexpr scene::DepthFormat of_transforms{scene::DepthFormat::Kind::d24, 24};
    if (!has_map(comparison)) {
        return "";
    }
    const auto light_distance_m = distances_m(comparison);
    const scene::LightFrustum& frustum = comparison.view.first_map();
    if (!light_distance_m || double{light_distance_m->median} <= frustum.near_m ||
        double{light_distance_m->median} >= frustum.far_m) {
        return "";
    }
    const double step_m =
        analysis::depth_step_length_m(frustum, of_transforms, double{light_distance_m->median});
    const double texel_m = frustum.texel_width_m(double{light_distance_m->median},
                                                 comparison.job.shadow_map.resolution_texels);
    // Flat receivers have no range; a step below a texel's width is invisible.
    if (step_m < texel_m ||
        step_m < too_long * (double{light_distance_m->max} - double{light_distance_m->min})) {
        return "";
    }
    return fmt::format("the map cannot tell depths apart, for with near = {:.3g} and far = {:.3g} "
                       "a step of 24 bits is {:.2g} {} at the median receiver; try near = \"auto\"",
                       frustum.near_m, frustum.far_m, step_m, length_unit(comparison));
}

/// "the scene's centre is 200,000 m from its origin"; empty if it is near.
std::string far_origin(const analysis::Comparison& comparison)
{
    const scene::Box box = comparison.triangles->bounds();
    const double away_m = glm::length(box.centre());
    return away_m > box.diagonal_m() ? fmt::format("the scene's centre is {} {} from its origin",
                                                   grouped_amount(away_m), length_unit(comparison))
                                     : "";
}

/// The main source of precision errors: the format, or float32 matrices and positions.
std::string precision_kinds(const analysis::Comparison& comparison)
{
    const auto& kinds = comparison.precision_kinds;
    if (!kinds || kinds->format + kinds->transform == 0 || !has_map(comparison)) {
        return "";
    }
    const auto all = static_cast<double>(kinds->format + kinds->transform);
    if (kinds->format >= kinds->transform) {
        return fmt::format(", {} of that to the format {}{}",
                           share_of(static_cast<double>(kinds->format), all),
                           scene::depth_format_name(comparison.job.shadow_map.depth_format),
                           step_at_median(comparison));
    }
    const std::string why = far_origin(comparison);
    return fmt::format(", {} of that to float32 matrices and positions{}{}",
                       share_of(static_cast<double>(kinds->transform), all),
                       why.empty() ? "" : ": ", why);
}

/// The job's biases that no constant bias compensates: slope, normal offset, and method-specific
/// ones.
std::string other_biases_text(const scene::Bias& bias)
{
    std::vector<std::string> others;
    if (bias.slope != 0) {
        others.push_back(fmt::format("a slope bias of {:.3g}", bias.slope));
    }
    if (bias.normal_texels != 0) {
        others.push_back(fmt::format("a normal offset of {:.3g} texels", bias.normal_texels));
    }
    for (const auto& [key, value] : bias.added) {
        if (value != 0) {
            others.push_back(fmt::format("{} = {:.3g}", key, value));
        }
    }
    return others.empty() ? "" : fmt::format("The job also sets {}", fmt::join(others, " and "));
}

constexpr std::size_t one_in_a_thousand = 1; // index of the 0.1 % allowance

/// Why pixels of a class are not scored, to follow "of the surface".
std::string_view why_not_scored(PixelClass pixel_class)
{
    switch (pixel_class) {
    case PixelClass::unmatched:
        return "is seen differently by GL and by the exact rays";
    case PixelClass::attached:
        return "faces away from the light";
    case PixelClass::out_of_light:
        return "is outside the light's cone";
    case PixelClass::indeterminate:
        return "lies exactly on a shadow's border";
    case PixelClass::background:
    case PixelClass::lit:
    case PixelClass::blocked:
        break;
    }
    return "";
}

std::string why_none_is_seen(const analysis::Comparison& comparison)
{
    const auto& objects = comparison.triangles->objects;
    if (std::ranges::none_of(objects, &scene::Object::receives)) {
        return "No pixel is scored: every object is in scene.no_receive, so none is drawn.";
    }
    return "No pixel is scored: the camera sees only background; point it at the scene.";
}

std::string why_none_is_scored(const analysis::Comparison& comparison)
{
    const analysis::ClassCounts& pixels = comparison.metrics.pixels;
    const std::uint64_t surface = pixels.total - pixels.of(PixelClass::background);
    if (surface == 0) {
        return why_none_is_seen(comparison);
    }
    std::vector<std::string> parts;
    for (const PixelClass pixel_class : {PixelClass::attached, PixelClass::out_of_light,
                                         PixelClass::unmatched, PixelClass::indeterminate}) {
        const std::uint64_t count = pixels.of(pixel_class);
        if (count == surface) {
            return fmt::format("No pixel is scored: all of the surface that the camera sees {}.",
                               why_not_scored(pixel_class));
        }
        if (count > 0) {
            parts.push_back(fmt::format("{} {}{}", percent(analysis::ratio(count, surface)),
                                        parts.empty() ? "of the surface that the camera sees " : "",
                                        why_not_scored(pixel_class)));
        }
    }
    return fmt::format("No pixel is scored: {}.", fmt::join(parts, ", "));
}

/// That the light is inside an object, with a trailing blank; empty if it is not.
std::string why_none_is_lit(const analysis::Comparison& comparison)
{
    if (comparison.light_shells.empty()) {
        return "";
    }
    const std::vector<std::string>& shells = comparison.light_shells;
    std::vector<std::string> no_cast = comparison.job.scene.no_cast;
    no_cast.insert(no_cast.end(), shells.begin(), shells.end());
    std::string inside = scene::to_toml(shells); // ["bulb", "shade"]
    inside = inside.substr(1, inside.size() - 2);
    const std::uint64_t lit = comparison.metrics.pixels.of(PixelClass::lit);
    return fmt::format(
        "{}: the light is inside {}. If that is part of the lamp, set scene.no_cast = {}. ",
        lit == 0 ? "No pixel is lit"
                 : fmt::format("Only {} of {} scored pixels are lit", grouped(lit),
                               grouped(comparison.metrics.pixels.scored())),
        inside, scene::to_toml(no_cast));
}

/// One phrase for each label that is worth naming, the most frequent first.
std::vector<std::string> error_phrases(const analysis::Comparison& comparison)
{
    const auto errors = analysis::named_errors(comparison).by_label;
    std::vector<std::string> phrases;
    for (const std::size_t label : largest_errors(errors)) {
        phrases.push_back(label_text(static_cast<analysis::Label>(label), errors.at(label),
                                     comparison.metrics.pixels, has_map(comparison)));
    }
    return phrases;
}

/// The summary if there are scored pixels.
std::string scored_error_summary(const analysis::Comparison& comparison)
{
    const analysis::ClassCounts& pixels = comparison.metrics.pixels;
    const auto errors = analysis::named_errors(comparison).by_label;
    const std::vector<std::string> parts = error_phrases(comparison);
    if (parts.empty()) {
        return softened_alone(comparison);
    }
    if (const std::string blind = blind_depths(comparison); !blind.empty()) {
        return fmt::format("{}{} of the surface is wrong: {}.", by_amount(comparison),
                           percent(analysis::ratio(sum_of(errors), pixels.scored())), blind);
    }
    return fmt::format("{}{}.{}", by_amount(comparison), fmt::join(parts, ", and "),
                       softened_too(comparison));
}

} // namespace

std::string error_summary(const analysis::Comparison& comparison)
{
    if (comparison.metrics.pixels.scored() == 0) {
        return why_none_is_scored(comparison);
    }
    return why_none_is_lit(comparison) + scored_error_summary(comparison);
}

std::string error_headline(const analysis::Comparison& comparison)
{
    const std::vector<std::string> phrases = error_phrases(comparison);
    if (!phrases.empty() && blind_depths(comparison).empty()) {
        return phrases.front() + (has_fractions(comparison.metrics) ? ", by amount" : "");
    }
    const std::string summary = error_summary(comparison);
    return summary.substr(0, summary.find_last_of('.'));
}

std::string cause_sentences(const analysis::Comparison& comparison, const analysis::Remedy* first)
{
    const auto errors = analysis::named_errors(comparison).by_cause;
    const double all = sum_of(errors);
    if (!blind_depths(comparison).empty()) {
        return "The error is due to the map's near and far planes.";
    }
    std::vector<std::string> sentences;
    if (has_map(comparison)) {
        sentences.push_back(cure_sentence(comparison, first));
    }
    std::vector<std::string> parts;
    for (const std::size_t i : largest_errors(errors)) {
        const auto cause = static_cast<Cause>(i);
        // Without a map no cure can be measured, so all causes are named.
        if (has_map(comparison) && !is_actionable(comparison, cause, first)) {
            continue;
        }
        const std::string share = share_of(errors.at(i), all);
        parts.push_back(fmt::format("{}{}{}{}", parts.empty() ? capitalised(share) : share,
                                    parts.empty() ? " of the error is due to " : " is due to ",
                                    cause_text(cause, has_map(comparison)),
                                    cause == Cause::precision ? precision_kinds(comparison) : ""));
    }
    if (!parts.empty()) {
        sentences.push_back(fmt::format("{}.", fmt::join(parts, "; ")));
    }
    std::erase(sentences, "");
    return fmt::format("{}", fmt::join(sentences, " "));
}

std::string bias_or_map_hint(const analysis::Comparison& comparison)
{
    constexpr double much = 0.25; // share of the error that biases cause
    const analysis::NamedErrors errors = analysis::named_errors(comparison);
    const auto causes = largest_errors(errors.by_cause);
    if (causes.empty()) {
        return "";
    }
    if (!has_map(comparison)) {
        return std::string{hint_without_map(static_cast<Cause>(causes.front()))};
    }
    return errors.of(Cause::bias) >= much * sum_of(errors.by_cause)
               ? other_biases_text(comparison.view.bias)
               : "";
}

std::string origin_hint(const analysis::Comparison& comparison)
{
    const auto& kinds = comparison.precision_kinds;
    const auto causes = largest_errors(analysis::named_errors(comparison).by_cause);
    const bool is_by_transforms = kinds && kinds->transform > kinds->format && !causes.empty() &&
                                  static_cast<Cause>(causes.front()) == Cause::precision;
    const std::string why = is_by_transforms ? far_origin(comparison) : "";
    return why.empty() ? ""
                       : fmt::format("The errors may come from float32 positions: {}. `--advise` "
                                     "measures what an origin nearby leaves.",
                                     why);
}

std::string unserved_bias_text(const analysis::Comparison& comparison)
{
    const auto& biases = comparison.diagnosis->biases;
    if (!biases || !biases->bounds.no_constant_bias_serves) {
        return "";
    }
    const analysis::BiasLimits& limits = biases->bounds.allowances[one_in_a_thousand];
    if (!std::isfinite(limits.acne_free_count)) {
        return "No constant bias frees this map of acne.";
    }
    if (limits.panning_free < 0) {
        return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                           "least {:.3g}, and light leaks even at a bias of 0.",
                           limits.acne_free_count);
    }
    return fmt::format("No constant bias keeps both kinds of errors below 0.1 %: acne needs at "
                       "least {:.3g}, and false light allows at most {:.3g}.",
                       limits.acne_free_count, limits.panning_free);
}

} // namespace gnomon::reports
