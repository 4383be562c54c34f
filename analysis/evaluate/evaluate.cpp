#include "analysis/evaluate/evaluate.hpp"

#include "analysis/evaluate/case_causes.hpp"
#include "analysis/evaluate/case_checks.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

using scene::Image;
using scene::Vec3d;
using scene::Vec3f;

/// The normal of each pixel's triangle on the visible side; NaN if neither normal nor eye tell
/// which side that is.
Image<Vec3f> seen_sides(const Case& subject, const CheckedCase& checked)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Image<Vec3f> normals{subject.layers.size(), Vec3f{nan}};
    for (std::size_t i = 0; i < normals.pixel_count(); ++i) {
        const std::uint32_t triangle = checked.truth.triangle[i];
        if (triangle == scene::no_triangle) {
            continue;
        }
        const Vec3d normal = glm::normalize(winding_normal(subject.mesh, triangle));
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

void find_gaps(const Case& subject, const CheckedCase& checked,
               const renderers::RoundedReference& truth, Comparison& comparison)
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
    comparison.evaluation->false_lit_gap_m = find_quantiles(std::move(gaps_m));
}

std::vector<std::string> keys_given(const scene::CaseFile& file)
{
    std::vector<std::string> keys{"image.width", "image.height"};
    for (const scene::Setting& setting : file.source.file) {
        keys.push_back(setting.spec->name);
    }
    return keys;
}

/// Whether any pixel's Ng tells the visible side.
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
    result.lookup = recorded_lookup(subject.layers, result.view.maps.size() > 1);
    result.truth = checked.truth.truth;
    result.truth_method = "exact for all positions that round to P";
    result.environment = std::move(environment);
    Evaluation& evaluation = result.evaluation.emplace(make_evaluation(subject, checked));
    const int taps = taps_of_mask(subject, result.job);
    result.metrics = measure(result.truth, result.lookup, taps);
    evaluation.by_object = errors_by_object(result.truth, result.lookup, result.receivers.triangle,
                                            subject.mesh, taps);
    find_case_causes(subject, truth, result);
    find_gaps(subject, checked, truth, result);
    return result;
}

} // namespace gnomon::analysis
