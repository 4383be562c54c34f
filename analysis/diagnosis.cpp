#include "analysis/diagnosis.hpp"

#include "analysis/map_errors.hpp"
#include "analysis/own_sheets.hpp"
#include "analysis/receiver_geometry.hpp"

#include <tbb/parallel_for.h>

#include <limits>

namespace gnomon::analysis {

namespace {

/// The lookup at the receiver itself, without any bias.
scene::LookupLayers look_up_unbiased(const scene::Job& job, const scene::View& view,
                                     const Renderers& renderers)
{
    scene::View unbiased = view;
    unbiased.bias = {};
    return renderers.look_up(job, unbiased);
}

std::vector<std::size_t> pixels_of(const CauseLayers& causes, Label label)
{
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < causes.label.pixel_count(); ++i) {
        if (causes.label[i] == label) {
            pixels.push_back(i);
        }
    }
    return pixels;
}

/// The pixels whose shadow the bias detached from its blocker. Where the map without bias was right
/// only because the receiver shadowed itself, nothing was attached: there the gap is the distance
/// to a blocker that the map does not see.
std::vector<std::size_t> detached(const CauseInputs& inputs, std::span<const std::size_t> pixels)
{
    const auto sees_own = sees_own_sheets(inputs, trace_lookups(inputs, pixels));
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (!sees_own[i]) {
            result.push_back(pixels[i]);
        }
    }
    return result;
}

/// Forgives gaps of at most the pixel's width, and remembers the answers: slope curves ask about
/// the same pixels again.
class FootprintForgiver {
public:
    FootprintForgiver(const scene::ExactLight& light, const ReceiverGeometry& geometry,
                      scene::ImageSize size)
        : light_{light},
          geometry_{geometry},
          answers_{size, unknown}
    {
    }

    std::vector<std::uint8_t> operator()(std::span<const std::size_t> pixels)
    {
        std::vector<std::size_t> asked;
        for (const std::size_t pixel : pixels) {
            if (answers_[pixel] == unknown) {
                asked.push_back(pixel);
            }
        }
        const auto blockers = light_.find_blockers(asked);
        for (std::size_t i = 0; i < asked.size(); ++i) {
            answers_[asked[i]] = blockers[i].gap_m <= geometry_.footprint_m(asked[i]) ? 1 : 0;
        }
        std::vector<std::uint8_t> forgiven;
        forgiven.reserve(pixels.size());
        for (const std::size_t pixel : pixels) {
            forgiven.push_back(answers_[pixel]);
        }
        return forgiven;
    }

private:
    static constexpr std::uint8_t unknown = 2;

    const scene::ExactLight& light_;
    const ReceiverGeometry& geometry_;
    scene::Image<std::uint8_t> answers_;
};

/// Light distance of the scored receivers [m]; NaN elsewhere.
scene::Image<float> light_distances_m(const scene::TruthLayers& truth,
                                      const ReceiverGeometry& geometry)
{
    scene::Image<float> zeta_m{truth.pixel_class.size(), std::numeric_limits<float>::quiet_NaN()};
    tbb::parallel_for(std::size_t{0}, zeta_m.pixel_count(), [&](std::size_t i) {
        if (scene::is_scored(truth.pixel_class[i])) {
            zeta_m[i] = static_cast<float>(geometry.zeta_m(i));
        }
    });
    return zeta_m;
}

/// Errors by distance, angle and object, at the job's bias.
void break_down(const ComparedLayers& layers, const scene::Image<float>& zeta_m,
                const scene::Image<float>& map_error_m, Diagnosis& diagnosis)
{
    const auto& classes = layers.truth.pixel_class;
    const scene::Image<float> no_criticals{diagnosis.biases ? scene::ImageSize{0, 0}
                                                            : classes.size(),
                                           std::numeric_limits<float>::quiet_NaN()};
    const BreakdownInputs inputs{classes, layers.lookup,
                                 diagnosis.biases ? diagnosis.biases->critical_bias : no_criticals,
                                 zeta_m, map_error_m};
    diagnosis.by_distance = errors_by_distance(inputs);
    diagnosis.by_angle = errors_by_angle(inputs);
    diagnosis.by_object =
        errors_by_object(classes, layers.lookup, layers.receivers.triangle, layers.triangles);
}

} // namespace

Diagnosis diagnose(const scene::Job& job, const scene::View& view, const ComparedLayers& layers,
                   const Renderers& renderers)
{
    const int resolution = job.shadow_map.resolution_texels;
    const scene::LookupLayers unbiased = look_up_unbiased(job, view, renderers);
    const bool has_many_taps = job.lookup.filter != scene::Filter::nearest;
    const auto map_depths = has_many_taps ? renderers.read_map_depths() : scene::Image<float>{};
    const auto light = renderers.make_exact_light(job, view, layers.receivers);
    const ReceiverGeometry geometry{layers.triangles, view, layers.receivers.triangle};
    const auto zeta_m = light_distances_m(layers.truth, geometry);

    Diagnosis diagnosis;
    const CauseInputs inputs{job.lookup, resolution, view.frustum.reversed, layers.truth, unbiased,
                             map_depths, *light};
    diagnosis.pixels = find_causes(inputs);
    diagnosis.causes = classify_errors(layers.truth, layers.lookup, diagnosis.pixels, view.bias);
    const auto panning = detached(inputs, pixels_of(diagnosis.causes, Label::peter_panning));
    diagnosis.peter_panning = measure_gaps(*light, panning, view.frustum, resolution);
    if (job.lookup.filter != scene::Filter::hardware) {
        const ForgiveGaps forgive = FootprintForgiver{*light, geometry, view.image};
        diagnosis.biases = answer_biases({job, view, layers.truth, layers.lookup, map_depths,
                                          diagnosis.pixels, zeta_m, forgive});
    }
    break_down(layers, zeta_m,
               map_depth_errors_m(inputs, view.frustum, job.shadow_map.depth_format), diagnosis);
    return diagnosis;
}

} // namespace gnomon::analysis
