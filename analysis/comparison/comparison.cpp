#include "analysis/comparison/comparison.hpp"

#include "analysis/bias/kept_terms.hpp"
#include "analysis/causes/precision_kinds.hpp"
#include "analysis/comparison/enclosed_light.hpp"
#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "methods/job_method.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

template <typename Pixel>
void require_size(std::string_view layer, const scene::Image<Pixel>& image, scene::ImageSize size)
{
    if (image.size() != size) {
        throw std::invalid_argument(fmt::format(
            "compare: renderers: layer {} is {}x{} but the image is {}x{}", layer,
            image.size().width_px, image.size().height_px, size.width_px, size.height_px));
    }
}

} // namespace

std::string scene_name(const scene::SceneSettings& settings)
{
    return settings.builtin.empty() ? settings.file.filename().string() : settings.builtin;
}

SceneSummary summarise_scene(const scene::SceneSettings& settings,
                             const scene::TriangleScene& triangles)
{
    SceneSummary summary;
    summary.name = scene_name(settings);
    summary.triangles = triangles.triangles.size();
    summary.objects = triangles.objects.size();
    summary.dropped_triangles = triangles.dropped_triangles;
    summary.ignored_primitives = triangles.ignored_primitives;
    summary.hash = scene::content_hash(triangles);
    return summary;
}

namespace {

Diagnosis diagnosis_of(const Comparison& comparison, int taps, renderers::Drawn drawn,
                       const Renderers& renderers, const DiagnosisRequest& request)
{
    const ComparedLayers layers{*comparison.triangles, comparison.receivers, comparison.truth,
                                comparison.lookup, taps};
    if (!methods::traits(comparison.job).has_map) {
        return diagnose_without_map(comparison.job, comparison.view, layers, renderers.reference);
    }
    ObservedLookup lookup = observe_lookup(
        comparison.job, comparison.view, *comparison.triangles, comparison.lookup,
        [drawn = std::move(drawn)] { return drawn; }, renderers.rasterizer);
    renderers.rasterizer.release_spares(); // before the step that takes the most memory
    return diagnose(layers, std::move(lookup), request, renderers.reference);
}

} // namespace

void measure_comparison(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                        const DiagnosisRequest& request)
{
    const scene::View& view = comparison.view;
    require_size("receivers", comparison.receivers.triangle, view.image);
    require_size("lookup", comparison.lookup.samples, view.image);
    require_size("truth", comparison.truth.pixel_class, view.image);
    require_size("witness", comparison.truth.witness, view.image);
    const int taps = methods::traits(comparison.job).equal_taps();
    comparison.metrics = measure(comparison.truth, comparison.lookup, taps);
    if (renderers.reference.has_light_queries()) {
        comparison.diagnosis = diagnosis_of(comparison, taps, std::move(drawn), renderers, request);
        renderers.rasterizer.release_spares();
        if (const auto& biases = comparison.diagnosis->biases) {
            comparison.held = compare_with_curve(comparison.lookup, comparison.receivers.triangle,
                                                 biases->critical_bias, view.bias.constant);
        }
    }
}

std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                  const renderers::Drawn& drawn,
                                                  const Renderers& renderers)
{
    if (!comparison.diagnosis || !comparison.diagnosis->biases) {
        return std::nullopt;
    }
    const BiasAnswers& answers = *comparison.diagnosis->biases;
    const auto& triangles = comparison.receivers.triangle;
    const std::array<float, 2> wanted{comparison.view.bias.constant, answers.best.recommended()};
    scene::View biased = comparison.view;
    return verify_biases(triangles, answers.critical_bias,
                         biases_to_verify(answers.critical_bias, triangles, wanted),
                         [&](float constant) {
                             biased.bias.constant = constant;
                             return renderers.rasterizer.look_up({drawn, comparison.job, biased});
                         });
}

std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                  const Renderers& renderers)
{
    if (!comparison.diagnosis || !comparison.diagnosis->biases) {
        return std::nullopt; // there are no critical biases to test
    }
    renderers::Rasterizer& rasterizer = renderers.rasterizer;
    return verify_comparison(
        comparison,
        {rasterizer.draw_receivers(comparison.view),
         renderers::draw_filtered_map(rasterizer, comparison.job, comparison.view)},
        renderers);
}

Comparison begin_comparison(const scene::Job& job, const scene::SceneFile& file,
                            SceneSummary summary, const Renderers& renderers)
{
    Comparison comparison;
    comparison.job = scene::with_layout(job, file.defaults);
    methods::check(comparison.job);
    comparison.view = scene::resolve_view(comparison.job, file.scene, file.defaults);
    const scene::CameraSettings camera =
        scene::aimed_camera(comparison.job, file.scene, file.defaults);
    comparison.target_distance_m = glm::length(camera.target - camera.eye);
    comparison.scene = std::move(summary);
    comparison.scene.notes =
        scene::scene_notes(file.scene, file.defaults, scene::left_to_file(job));
    comparison.triangles = &file.scene;
    comparison.truth_method = renderers.reference.truth_method();
    comparison.subpixel_bits = renderers.rasterizer.subpixel_bits();
    comparison.environment = renderers.environment;
    return comparison;
}

namespace {

std::optional<KeptTerms> kept_terms_of(const Comparison& comparison,
                                       const std::shared_ptr<const renderers::Receivers>& receivers,
                                       renderers::Rasterizer& rasterizer)
{
    if (!methods::moves_lookups(comparison.job, comparison.view)) {
        return std::nullopt;
    }
    return find_kept_terms(
        comparison.job, comparison.view, *comparison.triangles,
        {receivers, renderers::draw_filtered_map(rasterizer, comparison.job, comparison.view)},
        rasterizer);
}

/// The origin of the pixels' errors, judged by the same map as float32.
PrecisionKinds measure_precision_kinds(const Comparison& comparison,
                                       const std::shared_ptr<const renderers::Receivers>& receivers,
                                       const Renderers& renderers)
{
    const auto pixels =
        wrong_by_precision(comparison.diagnosis->causes.cause, comparison.truth, comparison.lookup);
    if (pixels.empty()) {
        return {};
    }
    if (!methods::traits(comparison.job).has_map) {
        return {.format = 0, .transform = pixels.size()};
    }
    // With these terms, only GL's own lookups apply.
    const bool is_looked_up =
        !methods::traits(comparison.job).compares_depths() ||
        (methods::traits(comparison.job).compares == methods::Compares::mean_depth &&
         methods::moves_lookups(comparison.job, comparison.view));
    if (is_looked_up) {
        const FloatLookups floats =
            look_up_floats(comparison.job, comparison.view, receivers, renderers.rasterizer);
        return find_precision_kinds(comparison.truth, floats.biased, floats.unbiased, pixels);
    }
    if (comparison.job.shadow_map.depth_format.kind == scene::DepthFormat::Kind::d32f) {
        return {.format = 0, .transform = pixels.size()}; // the map has 32-bit floats already
    }
    const FloatMap map = draw_float_map(comparison.job, comparison.view, comparison.lookup, pixels,
                                        receivers, renderers.rasterizer);
    const bool derives = map.unbiased.samples.empty();
    const auto light = renderers.reference.make_light_queries(comparison.job, comparison.view,
                                                              comparison.receivers);
    LookupRule rule = lookup_rule(comparison.job, comparison.view);
    rule.slope = 0;
    const auto terms = kept_terms_of(comparison, receivers, renderers.rasterizer);
    CauseInputs inputs{rule,
                       comparison.job.shadow_map.resolution_texels,
                       comparison.truth,
                       comparison.lookup,
                       derives ? comparison.lookup : map.unbiased,
                       map.depths,
                       *light};
    inputs.terms = terms ? &*terms : nullptr;
    return find_precision_kinds(inputs, pixels, comparison.view.bias);
}

/// The effect of the job's polygon offset at its pixels, if its maps have one.
std::optional<DrawnOffset> measure_drawn_offset(const Comparison& comparison,
                                                const Renderers& renderers)
{
    const auto offset = methods::map_offset(comparison.job, comparison.view);
    if (!offset) {
        return std::nullopt;
    }
    const scene::Image<scene::PixelClass>& classes = comparison.truth.pixel_class;
    const ReceiverGeometry geometry{*comparison.triangles, comparison.view,
                                    comparison.receivers.triangle};
    const scene::Image<float> light_distance_m = light_distances_m(classes, geometry);
    const auto units =
        renderers.rasterizer.measure_offset_units(comparison.job.shadow_map.depth_format);
    return find_drawn_offset(*offset, {*comparison.triangles,
                                       comparison.receivers.triangle,
                                       classes,
                                       light_distance_m,
                                       {comparison.view.maps, comparison.lookup.maps,
                                        comparison.job.shadow_map.resolution_texels},
                                       comparison.job.shadow_map.depth_format,
                                       units});
}

} // namespace

namespace {

/// Names the objects that enclose the light, and adds a note about them.
void find_light_shells(Comparison& comparison)
{
    comparison.light_shells =
        objects_around_light(*comparison.triangles, comparison.view, comparison.receivers.triangle,
                             comparison.truth.pixel_class);
    for (const std::string& name : comparison.light_shells) {
        comparison.scene.notes.push_back(scene::enclosed_light_note(name));
    }
}

} // namespace

void measure_fully(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                   const DiagnosisRequest& request)
{
    const std::shared_ptr<const renderers::Receivers> receivers = drawn.receivers;
    measure_comparison(comparison, std::move(drawn), renderers, request);
    find_light_shells(comparison);
    if (comparison.diagnosis) {
        comparison.precision_kinds = measure_precision_kinds(comparison, receivers, renderers);
    }
    comparison.drawn_offset = measure_drawn_offset(comparison, renderers);
}

ConfigurationResult result_of(const Comparison& comparison)
{
    ConfigurationResult result{comparison.metrics, std::nullopt, {}, {}};
    if (comparison.diagnosis) {
        result.causes = comparison.diagnosis->causes.counts;
        result.amounts = comparison.diagnosis->causes.amounts;
        result.peter_panning = comparison.diagnosis->peter_panning;
        result.cells = comparison.diagnosis->cells;
        result.by_map =
            results_of_maps(comparison.job, comparison.view, comparison.diagnosis->by_map);
    }
    return result;
}

std::vector<ConfigurationResult> results_of(std::span<const Comparison> comparisons)
{
    std::vector<ConfigurationResult> results;
    for (const Comparison& comparison : comparisons) {
        results.push_back(result_of(comparison));
    }
    return results;
}

FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                              std::uint64_t ordinal)
{
    if (!comparison.evaluation && !comparison.diagnosis) {
        throw std::invalid_argument("finish_compared: comparison: has no diagnosis");
    }
    FinishedCurve finished;
    if (comparison.diagnosis) {
        finished.curve = comparison.diagnosis->curve;
    }
    finished.curve.id = std::move(curve);
    finished.rows.push_back({ordinal, result_of(comparison)});
    return finished;
}

} // namespace gnomon::analysis
