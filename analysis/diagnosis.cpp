#include "analysis/diagnosis.hpp"

#include "analysis/blocker_gaps.hpp"
#include "analysis/critical_bias.hpp"
#include "analysis/depth/bin_envelopes.hpp"
#include "analysis/map_errors.hpp"
#include "analysis/own_sheets.hpp"
#include "analysis/receiver_geometry.hpp"

#include <limits>

namespace gnomon::analysis {

namespace {

/// The lookup at the receiver itself without any bias: derived, unless a normal offset moved the
/// lookup or the weights are the driver's own.
scene::LookupLayers look_up_unbiased(const scene::Job& job, const scene::View& view,
                                     const scene::LookupLayers& lookup,
                                     const scene::LookupLayers& deciding,
                                     const Renderers& renderers)
{
    if (can_derive_unbiased(job, view)) {
        return without_bias(lookup, deciding, lookup_rule(job, view));
    }
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

/// Errors by distance, angle and object, at the job's bias.
void break_down(const ComparedLayers& layers, const scene::LightFrustum& frustum,
                scene::DepthFormat format, Diagnosis& diagnosis)
{
    const auto& classes = layers.truth.pixel_class;
    const scene::Image<float> no_criticals{diagnosis.biases ? scene::ImageSize{0, 0}
                                                            : classes.size(),
                                           std::numeric_limits<float>::quiet_NaN()};
    const BreakdownInputs inputs{classes, layers.lookup,
                                 diagnosis.biases ? diagnosis.biases->critical_bias : no_criticals,
                                 diagnosis.map_error_m};
    diagnosis.by_distance = errors_by_bin(bin_by_distance(classes, diagnosis.zeta_m), inputs);
    add_envelopes(diagnosis.by_distance, frustum, format);
    diagnosis.by_angle = errors_by_bin(bin_by_angle(classes, layers.lookup), inputs);
    diagnosis.by_object =
        errors_by_object(classes, layers.lookup, layers.receivers.triangle, layers.triangles);
}

} // namespace

Diagnosis diagnose(const scene::Job& job, const scene::View& view, const ComparedLayers& layers,
                   const Renderers& renderers)
{
    const int resolution = job.shadow_map.resolution_texels;
    const bool has_curve = job.lookup.filter != scene::Filter::hardware;
    const auto map_depths = job.lookup.filter != scene::Filter::nearest
                                ? renderers.read_map_depths()
                                : scene::Image<float>{};
    const LookupRule rule = lookup_rule(job, view);
    const scene::LookupLayers deciding =
        has_curve
            ? deciding_samples({layers.lookup.samples}, layers.lookup.texels, map_depths, rule)
            : scene::LookupLayers{};
    const scene::LookupLayers unbiased =
        look_up_unbiased(job, view, layers.lookup, deciding, renderers);
    const auto light = renderers.make_exact_light(job, view, layers.receivers);
    const ReceiverGeometry geometry{layers.triangles, view, layers.receivers.triangle};

    Diagnosis diagnosis;
    diagnosis.zeta_m = light_distances_m(layers.truth.pixel_class, geometry);
    const CauseInputs inputs{job.lookup, resolution, view.frustum.reversed, layers.truth, unbiased,
                             map_depths, *light};
    diagnosis.pixels = find_causes(inputs);
    diagnosis.causes = classify_errors(layers.truth, layers.lookup, diagnosis.pixels, view.bias);
    const auto panning = detached_pixels(inputs, pixels_of(diagnosis.causes, Label::peter_panning));
    BlockerGaps gaps{view.image};
    gaps.find(*light, panning);
    diagnosis.peter_panning =
        measure_gaps(gaps_of_pixels(gaps, panning, geometry, view.frustum, resolution));
    if (has_curve) {
        const ForgiveGaps forgive = forgive_footprints(gaps, *light, geometry);
        diagnosis.biases = answer_biases(
            {job, view, layers.truth, deciding, diagnosis.pixels, diagnosis.zeta_m, forgive});
    }
    diagnosis.map_error_m =
        map_depth_errors_m(inputs, CentreHits{inputs}, view.frustum, job.shadow_map.depth_format);
    break_down(layers, view.frustum, job.shadow_map.depth_format, diagnosis);
    return diagnosis;
}

} // namespace gnomon::analysis
