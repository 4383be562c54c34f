#include "reports/text/answer_parts.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/pixels/error_clusters.hpp"
#include "analysis/pixels/statistics.hpp"
#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/error_text.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::Remedy;

/// A key to paste, with a constant bias's lengths: "bias.constant = 0.002  # 0.08 m, 5 texels".
std::string key_line(const analysis::Comparison& comparison, const Remedy& remedy,
                     const std::string& key)
{
    constexpr std::string_view comment = analysis::origin_comment; // marks a change that is no key
    if (key.starts_with(comment)) {
        return "Move " + key.substr(comment.size());
    }
    const bool has_length =
        remedy.bias && remedy.bias->depth > 0 && std::isfinite(remedy.bias->metres);
    if (!has_length || !key.starts_with("bias.constant")) {
        return key;
    }
    return fmt::format("{}  # {:.3g} {}, {:.3g} {}{}", key, remedy.bias->metres,
                       length_unit(comparison), remedy.bias->texels,
                       remedy.bias->texels == 1 ? "texel" : "texels", map_of_lengths(comparison));
}

/// "Biases from 0.064 m to 0.096 m are nearly as good."
std::string safe_range(const analysis::Recommendation& recommended, std::string_view unit)
{
    const double low_m = recommended.low.metres;
    const double high_m = recommended.high.metres;
    const bool has_end = std::isfinite(recommended.high.depth);
    const std::string range =
        recommended.low.depth == 0
            ? (has_end ? fmt::format("Biases up to {:.3g} {} are", high_m, unit)
                       : "All other biases are")
            : (has_end ? fmt::format("Biases from {:.3g} to {:.3g} {} are", low_m, high_m, unit)
                       : fmt::format("Biases from {:.3g} {} on are", low_m, unit));
    return range + " nearly as good.";
}

/// Whether the causes say more than the summary: what cures each, or why there is an error at all.
bool says_causes(const analysis::Comparison& comparison, const Remedy* first)
{
    const auto labels = largest_errors(analysis::named_errors(comparison).by_label);
    const bool knows_what_is_left = first != nullptr && first->left && labels.size() > 1;
    return knows_what_is_left || !comparison.cures.empty() ||
           !methods::traits(comparison.job).has_map;
}

std::vector<std::string> fix_sentences(const analysis::Comparison& comparison,
                                       const std::vector<Remedy>& remedies)
{
    const Remedy& first = remedies.front();
    const std::string_view unit = length_unit(comparison);
    std::vector<std::string> sentences{"This leaves " + remedy_effect(comparison, first)};
    if (recommends_constant_bias(comparison, remedies)) {
        sentences.push_back(safe_range(*comparison.diagnosis->curve.recommended, unit));
    }
    if (first.bias && first.bias->depth > 0 && std::isfinite(first.bias->metres)) {
        sentences.push_back(caster_sentence(*first.bias, unit));
    }
    return sentences;
}

std::uint64_t wrong_on(const analysis::ObjectErrors& object)
{
    return object.counts.false_shadow + object.counts.false_lit;
}

/// "stairs (80,940 px), ground (65,846)": of several objects those with the most errors.
std::string worst_objects(std::vector<analysis::ObjectErrors> objects)
{
    constexpr std::size_t most = 3;
    if (objects.size() < 2) {
        return {};
    }
    std::erase_if(objects, [](const auto& object) { return wrong_on(object) == 0; });
    std::ranges::stable_sort(objects, std::greater{}, wrong_on);
    std::string text;
    for (std::size_t i = 0; i < std::min(objects.size(), most); ++i) {
        text += fmt::format("{}{} ({}{})", i == 0 ? "" : ", ", objects[i].name,
                            grouped(wrong_on(objects[i])), i == 0 ? " px" : "");
    }
    return text;
}

/// " on stairs": the object that a pixel shows; empty if the scene has only one.
std::string on_object(const analysis::Comparison& comparison, std::size_t pixel)
{
    const auto* const triangles = comparison.triangles;
    if (triangles == nullptr || triangles->objects.size() < 2) {
        return {};
    }
    const std::size_t object = triangles->object_of(comparison.receivers.triangle[pixel]);
    return fmt::format(" on {}", triangles->objects[object].name);
}

/// "largest patch: 4,321 px around (612, 433) on stairs"
std::string largest_patch(const analysis::Comparison& comparison)
{
    const auto wrong = analysis::wrong_pixels(comparison.truth, comparison.lookup);
    const auto patch = analysis::largest_cluster(wrong);
    return patch ? fmt::format("largest patch: {} px around ({}, {}){}", grouped(patch->pixels),
                               patch->x_px, patch->y_px,
                               on_object(comparison, wrong.index(patch->x_px, patch->y_px)))
                 : std::string{};
}

/// Pixels that GL and the rays see differently, or whose truth is open, if there are many.
std::vector<std::string> unscored_pixels(const analysis::ClassCounts& pixels)
{
    constexpr double many = 0.01; // of the surface
    std::vector<std::string> sentences;
    const auto add = [&](scene::PixelClass pixel_class, std::string_view why) {
        const std::uint64_t count = pixels.of(pixel_class);
        const auto share = analysis::ratio(count, pixels.surface());
        if (share > many) {
            sentences.push_back(fmt::format("{} of the surface ({}) is not scored: {}.",
                                            percent(share), counted(count, "pixel"), why));
        }
    };
    add(scene::PixelClass::unmatched, "GL and the exact rays see different triangles there");
    add(scene::PixelClass::indeterminate, "it lies exactly on a shadow's border");
    return sentences;
}

std::string position_sentence(const analysis::ImportCheck& check)
{
    if (check.silhouette_pixels) {
        return fmt::format("The image has no positions: P is of the camera's pixel centres. {} {} "
                           "left out, which a silhouette may cross.",
                           counted(*check.silhouette_pixels, "pixel"),
                           *check.silhouette_pixels == 1 ? "is" : "are");
    }
    return fmt::format("99 % of the positions are within {:.2g} m of the mesh; {:.2g} m is "
                       "tolerated.",
                       check.distances.p99_m, check.distances.tolerance_m);
}

void add_import(AnswerLines& lines, const analysis::Evaluation& evaluation)
{
    const analysis::ImportCheck& check = evaluation.import_check;
    std::string text = position_sentence(check);
    if (check.agreement) {
        text += fmt::format(" Mask and truth agree by {:.3g} (1 is everywhere, 0 is by chance).",
                            *check.agreement);
    }
    lines.entry("mesh", text);
    if (!check.warning.empty()) {
        lines.flagged("warning", capitalised(check.warning) + ".", Tone::bad);
    }
    if (evaluation.off_surface_pixels > 0) {
        lines.flagged("warning",
                      fmt::format("{} not decided: farther than {:.2g} m from the surface.",
                                  counted(evaluation.off_surface_pixels, "pixel"),
                                  evaluation.most_distance_m),
                      Tone::bad);
    }
}

} // namespace

void add_fix(AnswerLines& lines, const analysis::Comparison& comparison,
             const std::vector<Remedy>& remedies)
{
    const Remedy* const first = remedies.empty() ? nullptr : &remedies.front();
    std::vector<std::string> sentences;
    std::string_view label = "fix";
    if (first != nullptr) {
        for (const std::string& key : first->keys) {
            lines.entry(label, key_line(comparison, *first, key), Tone::good);
            label = "";
        }
        sentences = fix_sentences(comparison, remedies);
    } else if (std::string hint = hint_sentence(comparison); !hint.empty()) {
        sentences.push_back(std::move(hint));
    }
    std::string causes = says_causes(comparison, first) ? cause_sentences(comparison, first) : "";
    if (first != nullptr && !causes.empty()) {
        sentences.push_back(std::exchange(causes, ""));
    }
    if (!sentences.empty()) {
        lines.entry(label, fmt::format("{}", fmt::join(sentences, " ")));
    }
    if (!causes.empty()) {
        lines.entry("cause", causes);
    }
}

void add_places(AnswerLines& lines, const analysis::Comparison& comparison)
{
    std::vector<std::string> places{
        comparison.diagnosis    ? worst_objects(comparison.diagnosis->by_object)
        : comparison.evaluation ? worst_objects(comparison.evaluation->by_object)
                                : std::string{},
        largest_patch(comparison)};
    std::erase(places, "");
    if (!places.empty()) {
        lines.entry("look at", fmt::format("{}", fmt::join(places, "; ")));
    }
}

void add_warnings(AnswerLines& lines, const analysis::Comparison& comparison,
                  const std::vector<Remedy>& remedies)
{
    std::vector<std::string> warnings = unscored_pixels(comparison.metrics.pixels);
    if (comparison.diagnosis) {
        std::ranges::move(warning_sentences(comparison, remedies), std::back_inserter(warnings));
    }
    for (const std::string& warning : warnings) {
        lines.flagged("warning", warning, Tone::bad);
    }
    for (const scene::SceneNote& note : comparison.scene.notes) {
        // The headline already says that the light is inside an object.
        if (note.kind != "enclosed_light" || comparison.light_shells.empty()) {
            lines.entry("note", capitalised(note.text) + ".");
        }
    }
}

void add_evaluation(AnswerLines& lines, const analysis::Comparison& comparison,
                    const analysis::Evaluation& evaluation)
{
    if (const auto& found = evaluation.bias_causes; found && !comparison.diagnosis) {
        lines.entry("causes",
                    fmt::format("The bias makes {} wrong: {} peter-panning, {} overshadow. The "
                                "causes of {} are not told apart.",
                                counted(found->bias(), "pixel"), grouped(found->peter_panning),
                                grouped(found->overshadow), counted(found->unknown, "other")));
    }
    add_import(lines, evaluation);
    if (const std::uint64_t pixels = evaluation.contradicted_pixels.value_or(0); pixels > 0) {
        lines.flagged("warning",
                      fmt::format("The mask contradicts its own lookup at {}: z.light, z.map and "
                                  "the bias give the other verdict. Causes and the fix are the "
                                  "lookup's; look at how mask and depths are written.",
                                  counted(pixels, "scored pixel")),
                      Tone::bad);
    }
    for (const analysis::UnansweredQuestion& one : evaluation.cannot_know) {
        lines.entry("unknown", fmt::format("{}; needs {}.", capitalised(one.what), one.needs));
    }
}

void add_requested(AnswerLines& lines, const analysis::Comparison& comparison)
{
    if (comparison.verification) {
        lines.entry("verified", capitalised(verification_text(*comparison.verification)) + ".");
    }
    std::string_view label = "audit";
    for (const scene::FloatMethodErrors& method : comparison.float_audit) {
        lines.entry(label,
                    fmt::format("{}: wrong at {}, {} false blocked and {} false lit", method.name,
                                counted(method.false_blocked + method.false_lit, "pixel"),
                                grouped(method.false_blocked), grouped(method.false_lit)));
        label = "";
    }
}

} // namespace gnomon::reports
