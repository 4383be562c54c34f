#include "analysis/diagnosis.hpp"

#include "analysis/critical_bias.hpp"
#include "analysis/own_sheets.hpp"
#include "analysis/receiver_geometry.hpp"

#include <vector>

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
    const auto [lookups, hits] = trace_lookups(inputs, pixels);
    const auto sees_own = sees_own_sheets(inputs, lookups, hits);
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (!sees_own[i]) {
            result.push_back(pixels[i]);
        }
    }
    return result;
}

scene::Image<std::uint8_t> acne_flags(const scene::TruthLayers& truth,
                                      const scene::Image<PixelCause>& pixels)
{
    scene::Image<std::uint8_t> flags{truth.pixel_class.size()};
    for (std::size_t i = 0; i < flags.pixel_count(); ++i) {
        flags[i] = is_acne_if_shadowed(pixels[i], truth.pixel_class[i]) ? 1 : 0;
    }
    return flags;
}

/// A gap of at most the width of the pixel is forgiven.
ForgiveGaps forgive_footprints(const scene::ExactLight& light, const ReceiverGeometry& geometry)
{
    return [&light, &geometry](std::span<const std::size_t> pixels) {
        const auto blockers = light.find_blockers(pixels);
        std::vector<std::uint8_t> forgiven(pixels.size());
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            forgiven[i] = blockers[i].gap_m <= geometry.footprint_m(pixels[i]) ? 1 : 0;
        }
        return forgiven;
    };
}

BiasAnswers answer_biases(const LookupRule& rule, const ComparedLayers& layers,
                          const scene::Image<float>& map_depths,
                          const scene::Image<std::uint8_t>& acne, const ForgiveGaps& forgive)
{
    const auto& classes = layers.truth.pixel_class;
    auto critical = critical_biases(
        deciding_samples(layers.lookup, layers.lookup.texels, map_depths, rule), rule);
    BiasCurve curve{critical, classes};
    const BestBiases best = find_best_biases(curve);
    const BiasBounds bounds = find_bias_bounds(curve, critical, classes, acne, forgive);
    return {std::move(critical), std::move(curve), best, bounds};
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

    Diagnosis diagnosis;
    const CauseInputs inputs{job.lookup, resolution, view.frustum.reversed, layers.truth, unbiased,
                             map_depths, *light};
    diagnosis.pixels = find_causes(inputs);
    diagnosis.causes = classify_errors(layers.truth, layers.lookup, diagnosis.pixels, view.bias);
    const auto panning = detached(inputs, pixels_of(diagnosis.causes, Label::peter_panning));
    diagnosis.peter_panning = measure_gaps(*light, panning, view.frustum, resolution);
    if (job.lookup.filter != scene::Filter::hardware) {
        const ReceiverGeometry geometry{layers.triangles, view, layers.receivers.triangle};
        diagnosis.biases = answer_biases(lookup_rule(job, view), layers, map_depths,
                                         acne_flags(layers.truth, diagnosis.pixels),
                                         forgive_footprints(*light, geometry));
    }
    return diagnosis;
}

} // namespace gnomon::analysis
