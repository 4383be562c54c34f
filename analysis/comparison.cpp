#include "analysis/comparison.hpp"

#include "analysis/answers/diagnose.hpp"
#include "analysis/bias/kept_terms.hpp"
#include "analysis/causes/float_map.hpp"
#include "analysis/enclosed_light.hpp"
#include "analysis/pixels/receiver_geometry.hpp"
#include "methods/job_method.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <chrono>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Adds the wall time of a stage to `seconds` when it goes out of scope.
class StageTimer {
public:
    explicit StageTimer(double& seconds) : seconds_{seconds} {}
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;
    ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

template <typename Stage>
auto timed(double& seconds, Stage&& stage)
{
    const StageTimer timer{seconds};
    return stage();
}

void require_renderers(const Renderers& renderers)
{
    if (!renderers.draw_receivers || !renderers.draw_shadow_map || !renderers.look_up ||
        !renderers.find_truth ||
        (renderers.make_exact_light &&
         (!renderers.read_map_depths || !renderers.read_float_depths))) {
        throw std::invalid_argument("compare: renderers: a stage has no callable");
    }
}

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

void measure_comparison(Comparison& comparison, const Renderers& renderers,
                        const DiagnosisRequest& request)
{
    const scene::View& view = comparison.view;
    require_size("receivers", comparison.receivers.triangle, view.image);
    require_size("lookup", comparison.lookup.samples, view.image);
    require_size("truth", comparison.truth.pixel_class, view.image);
    require_size("witness", comparison.truth.witness, view.image);
    const int taps = methods::promises(comparison.job).equal_taps();
    comparison.metrics = measure(comparison.truth, comparison.lookup, taps);
    if (renderers.make_exact_light) {
        comparison.diagnosis = diagnose(comparison.job, view,
                                        {*comparison.triangles, comparison.receivers,
                                         comparison.truth, comparison.lookup, taps},
                                        request, renderers);
        if (const auto& biases = comparison.diagnosis->biases) {
            comparison.held = hold_to_curve(comparison.lookup, comparison.receivers.triangle,
                                            biases->critical_bias, view.bias.constant);
        }
    }
}

std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                  const Renderers& renderers)
{
    if (!comparison.diagnosis || !comparison.diagnosis->biases) {
        return std::nullopt;
    }
    const BiasAnswers& answers = *comparison.diagnosis->biases;
    const auto& triangles = comparison.receivers.triangle;
    const std::array<float, 2> wanted{comparison.view.bias.constant, answers.best.recommended()};
    renderers.draw_map(comparison.job, comparison.view);
    return verify_biases(comparison.job, comparison.view, triangles, answers.critical_bias,
                         biases_to_verify(answers.critical_bias, triangles, wanted), renderers);
}

Comparison begin_comparison(const scene::Job& job, const scene::SceneFile& file,
                            SceneSummary summary, const Renderers& renderers)
{
    require_renderers(renderers);
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
    comparison.truth_method = renderers.truth_method;
    comparison.subpixel_bits = renderers.subpixel_bits;
    comparison.environment = renderers.environment;
    return comparison;
}

namespace {

/// What the same map of 32-bit floats says of the pixels.
PrecisionKinds measure_precision_kinds(const Comparison& comparison, const Renderers& renderers)
{
    const auto pixels =
        wrong_by_precision(comparison.diagnosis->causes.cause, comparison.truth, comparison.lookup);
    if (pixels.empty()) {
        return {};
    }
    if (!methods::promises(comparison.job).has_map) {
        return {.format = 0, .transform = pixels.size()};
    }
    // Terms of the lookup's place or of the map are in GL's own mean depth.
    const bool is_looked_up =
        !methods::promises(comparison.job).compares_depths() ||
        (methods::promises(comparison.job).compares == methods::Compares::mean_depth &&
         methods::moves_lookups(comparison.job, comparison.view));
    if (is_looked_up) {
        const FloatLookups floats = look_up_floats(comparison.job, comparison.view, renderers);
        return find_precision_kinds(comparison.truth, floats.biased, floats.unbiased, pixels);
    }
    if (comparison.job.shadow_map.depth_format.kind == scene::DepthFormat::Kind::d32f) {
        return {.format = 0, .transform = pixels.size()}; // such a map is its own
    }
    const FloatMap map =
        draw_float_map(comparison.job, comparison.view, comparison.lookup, pixels, renderers);
    const bool derives = map.unbiased.samples.empty();
    const auto light =
        renderers.make_exact_light(comparison.job, comparison.view, comparison.receivers);
    LookupRule rule = lookup_rule(comparison.job, comparison.view);
    rule.slope = 0;
    const auto terms =
        find_kept_terms(comparison.job, comparison.view, *comparison.triangles, renderers);
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

/// What the job's polygon offset is at its pixels, where its maps have one.
std::optional<DrawnOffset> measure_drawn_offset(const Comparison& comparison,
                                                const Renderers& renderers)
{
    const auto offset = methods::map_offset(comparison.job, comparison.view);
    if (!offset || !renderers.measure_offset_units) {
        return std::nullopt;
    }
    const scene::Image<scene::PixelClass>& classes = comparison.truth.pixel_class;
    const ReceiverGeometry geometry{*comparison.triangles, comparison.view,
                                    comparison.receivers.triangle};
    const scene::Image<float> light_distance_m = light_distances_m(classes, geometry);
    const auto units = renderers.measure_offset_units(comparison.job.shadow_map.depth_format);
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

/// Objects that enclose the light are named, and noted among what to know of the scene.
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

void finish_comparison(Comparison& begun, const Renderers& renderers)
{
    StageSeconds& seconds = begun.seconds;
    const scene::Job& job = begun.job;
    const scene::View& view = begun.view;

    begun.receivers = timed(seconds.receivers, [&] { return renderers.draw_receivers(view); });
    timed(seconds.shadow_map, [&] { renderers.draw_map(job, view); });
    begun.lookup = timed(seconds.lookup, [&] { return renderers.look_up(job, view); });
    begun.truth = timed(seconds.truth, [&] { return renderers.find_truth(view, begun.receivers); });

    timed(seconds.analysis, [&] {
        measure_comparison(begun, renderers, {view.bias.constant, MapAfterDiagnosis::given_back});
    });
    timed(seconds.analysis, [&] { find_light_shells(begun); });
    if (begun.diagnosis) {
        begun.precision_kinds =
            timed(seconds.analysis, [&] { return measure_precision_kinds(begun, renderers); });
    }
    begun.drawn_offset =
        timed(seconds.analysis, [&] { return measure_drawn_offset(begun, renderers); });
}

Comparison compare(const scene::Job& job, const scene::SceneFile& file, const Renderers& renderers)
{
    double scene_seconds = 0;
    Comparison result = timed(scene_seconds, [&] {
        return begin_comparison(job, file, summarise_scene(job.scene, file.scene), renderers);
    });
    result.seconds.scene = scene_seconds;
    finish_comparison(result, renderers);
    return result;
}

} // namespace gnomon::analysis
