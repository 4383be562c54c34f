#include "analysis/evaluate/evaluate.hpp"

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/evaluate/bias_causes.hpp"
#include "analysis/evaluate/offset_check.hpp"
#include "analysis/evaluate/recorded_lookup.hpp"
#include "analysis/evaluate/view_check.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "methods/job_method.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// The normal of T on the side that is seen; NaN where neither normal nor eye tell.
Image<Vec3f> seen_sides(const Case& subject, const CheckedCase& checked)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image<Vec3f> normals{subject.layers.size(), Vec3f{nan}};
    for (std::size_t i = 0; i < normals.pixel_count(); ++i) {
        const std::uint32_t triangle = checked.truth.triangle[i];
        if (triangle == scene::no_triangle) {
            continue;
        }
        const auto [a, b, c] = subject.mesh.corners(triangle);
        const Vec3d normal = glm::normalize(glm::cross(Vec3d{b} - Vec3d{a}, Vec3d{c} - Vec3d{a}));
        double side =
            subject.layers.normal.empty() ? 0.0 : glm::dot(normal, Vec3d{subject.layers.normal[i]});
        if (!(std::abs(side) > 0) && subject.file.eye) {
            side = glm::dot(normal, *subject.file.eye - Vec3d{subject.layers.position[i]});
        }
        if (std::abs(side) > 0) {
            normals[i] = Vec3f{side > 0 ? normal : -normal};
        }
    }
    return normals;
}

/// The lookup as far as the case tells it.
/// @param has_maps  the light has several.
scene::LookupLayers lookup_of(const scene::CaseLayers& layers, bool has_maps)
{
    scene::LookupLayers lookup{Image<scene::LookupSample>{layers.size()}, layers.texels,
                               has_maps ? layers.maps : scene::MapIndices{}};
    lookup.kernel_axes = layers.kernel_axes;
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        scene::LookupSample& sample = lookup.samples[i];
        sample.verdict = layers.mask[i];
        sample.receiver_depth = layers.z_light.empty() ? 0.0F : layers.z_light[i];
        sample.map_depth = layers.z_map.empty() ? 0.0F : layers.z_map[i];
        sample.tan_theta = layers.tan_theta.empty() ? 0.0F : layers.tan_theta[i];
    }
    return lookup;
}

/// What the mask's values are multiples of, as its filter promises: each by a float32's rounding.
/// 0 where they are not, or the filter is not known: a mask is the renderer's own.
int taps_of_mask(const Case& subject, const scene::Job& job)
{
    constexpr double rounding = 0x1p-20; // of a float32 below 1, times at most 81 taps
    if (!subject.file.says("lookup.filter") && !subject.file.says("method.name")) {
        return 0;
    }
    const int taps = methods::traits(job).equal_taps();
    const bool are_multiples = std::ranges::all_of(subject.layers.mask, [&](float lit) {
        const double share = double{lit} * taps;
        return std::isnan(lit) || std::abs(share - std::nearbyint(share)) <= rounding;
    });
    return are_multiples ? taps : 0;
}

/// What the case recorded of a lookup, and what follows from that.
/// @param job   as the case describes it.
/// @param own   the lookup's layers, with the view's biases.
ObservedLookup observe_recorded(const scene::CaseLayers& layers, const scene::Job& job,
                                const scene::View& view, scene::LookupLayers own)
{
    const methods::LookupTraits promised = methods::traits(job);
    const RecordedLookup recorded{layers};
    const bool answers = recorded.answers(job);
    const auto with = [view](float constant, float slope) {
        scene::View biased = view;
        biased.bias.constant = constant;
        biased.bias.slope = slope;
        return biased;
    };
    const auto look_up = [=, &layers](const scene::View& biased) {
        return answers ? recorded.look_up(job, biased) : layers.unmoved;
    };
    ObservedLookup lookup{job, view, std::move(own)};
    if (!can_derive_unbiased(job, view)) {
        scene::View unbiased = view;
        unbiased.bias = {};
        lookup.unbiased = look_up(unbiased);
        if (!layers.terms.moved.empty()) {
            lookup.terms = make_kept_terms(job, view, layers.terms, std::nullopt);
        }
    }
    if (!promised.has_one_tap()) {
        lookup.map_depths = layers.map_depths;
    }
    if (answers && promised.has_curve() && !promised.has_formula()) {
        lookup.reruns = {
            [=](float constant, float slope) { return look_up(with(constant, slope)); },
            [=](float slope) { return recorded.find_critical_biases(job, with(0, slope)); }};
    }
    const bool has_curve = promised.has_formula() || lookup.reruns;
    if (!has_curve && promised.has_fractions() && view.bias.constant != 0) {
        const scene::View at_zero = with(0, view.bias.slope);
        if (scene::LookupLayers unbiased = look_up(at_zero); !unbiased.samples.empty()) {
            lookup.without_constant = [=, &layers] {
                return observe_recorded(layers, job, at_zero, unbiased);
            };
        }
    }
    return lookup;
}

/// Whether the lookup without any bias is known, or follows.
bool knows_unbiased(const Comparison& comparison, const scene::CaseLayers& layers)
{
    return can_derive_unbiased(comparison.job, comparison.view) || !layers.unmoved.samples.empty();
}

std::string listed(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, ", "));
}

/// How many scored pixels the lookup of the case would have decided otherwise than its mask.
std::uint64_t count_contradicted(const Comparison& comparison, const BiasAnswers& answers)
{
    std::uint64_t pixels = 0;
    for (std::size_t i = 0; i < answers.critical_bias.pixel_count(); ++i) {
        const bool is_lit = answers.critical_bias[i] <= comparison.view.bias.constant;
        if (scene::is_scored(comparison.truth.pixel_class[i]) &&
            scene::is_lit(comparison.lookup.samples[i].verdict) != is_lit) {
            ++pixels;
        }
    }
    return pixels;
}

/// Causes as far as they can be known, and why no further.
void find_all_causes(const Case& subject, const renderers::RoundedReference& truth,
                     Comparison& comparison, Evaluation& evaluation)
{
    const auto cannot = [&](std::string needs) {
        evaluation.cannot_know.push_back({"causes, labels, bias curve", std::move(needs)});
    };
    const auto missing = missing_for_causes(subject.file, comparison.job, subject.layers);
    if (!missing.empty()) {
        cannot(listed(missing));
        return;
    }
    if (!knows_unbiased(comparison, subject.layers)) {
        cannot("unmoved.*: the lookup that no bias moves");
        return;
    }
    const std::string disagreement = find_disagreement(
        comparison.view, subject.layers, subject.mesh, comparison.receivers.triangle,
        evaluation.import_check.distances.tolerance_m);
    if (!disagreement.empty()) {
        cannot(disagreement);
        return;
    }
    evaluation.has_map = true;
    if (evaluation.import_check.warning.empty()) {
        evaluation.import_check.warning = check_offset(comparison, subject.layers);
    }
    comparison.diagnosis = diagnose(
        {subject.mesh, comparison.receivers, comparison.truth, comparison.lookup,
         taps_of_mask(subject, comparison.job)},
        observe_recorded(subject.layers, comparison.job, comparison.view, comparison.lookup),
        {comparison.view.bias.constant}, truth);
    // Of weights that lie between texels' centres the renderer's own are rounded otherwise.
    const auto& biases = comparison.diagnosis->biases;
    if (biases && methods::traits(comparison.job).has_formula()) {
        evaluation.contradicted_pixels = count_contradicted(comparison, *biases);
    }
}

/// What r and d say where nothing else does.
void find_some_causes(const Case& subject, const Comparison& comparison, Evaluation& evaluation)
{
    const scene::CaseLayers& layers = subject.layers;
    const bool has_one_tap =
        subject.file.says("lookup.filter") && methods::traits(comparison.job).has_one_tap();
    std::vector<std::string> missing;
    for (const auto& [is_there, what] :
         {std::pair{!layers.z_light.empty(), "z.light"},
          {!layers.z_map.empty(), "z.map"},
          {has_one_tap, "lookup.filter = \"nearest\""},
          {!scene::mixes_maps(comparison.job), "shadow_map.blend = 0"}}) {
        if (!is_there) {
            missing.emplace_back(what);
        }
    }
    for (const std::string_view key : methods::moving_bias_keys(comparison.job)) {
        const scene::Key* row = scene::keys_of(comparison.job).find(key);
        if (row == nullptr) {
            continue;
        }
        // Few renderers have the terms that bring keys of their own: those need not be said.
        const bool is_known = row->is_added() || subject.file.says(key);
        if (!is_known ||
            scene::value_in(*row, comparison.job) != scene::default_of(*row, comparison.job)) {
            missing.push_back(fmt::format("{} = {}", key, row->default_text));
        }
    }
    if (missing.empty()) {
        evaluation.bias_causes =
            find_bias_causes(layers, comparison.truth, comparison.job.shadow_map.frustum.reversed);
    } else {
        evaluation.cannot_know.push_back({"which pixels are wrong by the bias", listed(missing)});
    }
}

void find_gaps(const Case& subject, const CheckedCase& checked,
               const renderers::RoundedReference& truth, const Comparison& comparison,
               Evaluation& evaluation)
{
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < subject.layers.mask.pixel_count(); ++i) {
        if (scene::is_blocked(comparison.truth.pixel_class[i]) &&
            scene::is_lit(subject.layers.mask[i])) {
            pixels.push_back(i);
        }
    }
    if (pixels.empty()) {
        return;
    }
    std::vector<float> gaps_m;
    for (const renderers::BlockerHit& hit : truth.find_rounded_blockers(
             checked.view.light, checked.receivers, checked.truth, pixels)) {
        gaps_m.push_back(static_cast<float>(hit.gap_m * subject.file.space.metres_per_unit));
    }
    evaluation.false_lit_gap_m = find_quantiles(std::move(gaps_m));
}

std::vector<std::string> keys_given(const scene::CaseFile& file)
{
    std::vector<std::string> keys{"image.width", "image.height"};
    for (const scene::Setting& setting : file.source.file) {
        keys.push_back(setting.spec->name);
    }
    return keys;
}

/// Whether any pixel's Ng says which side is seen.
bool has_normals(const scene::CaseLayers& layers)
{
    for (std::size_t i = 0; i < layers.normal.pixel_count(); ++i) {
        const Vec3d normal{layers.normal[i]};
        const double square = glm::dot(normal, normal);
        if (square > 0 && std::isfinite(square) && !std::isnan(layers.position[i].x)) {
            return true;
        }
    }
    return false;
}

Evaluation make_evaluation(const Case& subject, const CheckedCase& checked)
{
    Evaluation evaluation;
    evaluation.case_name = subject.file.name;
    const bool knows_side = subject.file.eye || has_normals(subject.layers);
    evaluation.most_distance_m =
        checked.receivers.most_distance_m * subject.file.space.metres_per_unit;
    evaluation.level = knows_side ? 1 : 0;
    evaluation.import_check = checked.check;
    evaluation.points = subject.layers.position;
    evaluation.normal = seen_sides(subject, checked);
    evaluation.has_camera = subject.file.says("camera.target") && !subject.file.space.is_mirrored();
    evaluation.given_keys = keys_given(subject.file);
    for (const float growth : checked.truth.growth_m) {
        if (std::isinf(growth)) {
            ++evaluation.off_surface_pixels;
            continue;
        }
        const double growth_m = double{growth} * subject.file.space.metres_per_unit;
        evaluation.largest_growth_m = std::max(evaluation.largest_growth_m, growth_m);
        evaluation.grown_pixels += growth_m > 0 ? 1 : 0;
    }
    if (!knows_side) {
        evaluation.cannot_know.push_back(
            {"attached (the side that is seen turned from the light)", "Ng or camera.eye"});
    }
    return evaluation;
}

} // namespace

Comparison evaluate(const Case& subject, CheckedCase checked,
                    const renderers::RoundedReference& truth, Environment environment)
{
    Comparison result;
    result.job = checked.job;
    result.view = checked.view;
    if (subject.file.says("camera.target") && result.job.camera) {
        result.target_distance_m = glm::length(result.job.camera->target - result.job.camera->eye);
    }
    result.scene = summarise_scene(checked.job.scene, subject.mesh);
    result.scene.notes = scene::scene_notes(subject.mesh, {}, {}); // the case has its own light
    result.triangles = &subject.mesh;
    result.receivers.triangle = checked.truth.triangle;
    result.lookup = lookup_of(subject.layers, result.view.maps.size() > 1);
    result.truth = checked.truth.truth;
    result.truth_method = "exact for all positions that round to P";
    result.environment = std::move(environment);
    Evaluation& evaluation = result.evaluation.emplace(make_evaluation(subject, checked));
    const int taps = taps_of_mask(subject, result.job);
    result.metrics = measure(result.truth, result.lookup, taps);
    evaluation.by_object = errors_by_object(result.truth, result.lookup, result.receivers.triangle,
                                            subject.mesh, taps);
    find_all_causes(subject, truth, result, evaluation);
    if (!result.diagnosis) {
        find_some_causes(subject, result, evaluation);
    }
    find_gaps(subject, checked, truth, result, evaluation);
    return result;
}

} // namespace gnomon::analysis
