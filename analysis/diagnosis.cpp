#include "analysis/diagnosis.hpp"

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
    diagnosis.pixels = find_causes({job.lookup, resolution, view.frustum.reversed, layers.truth,
                                    unbiased, map_depths, *light});
    diagnosis.causes = classify_errors(layers.truth, layers.lookup, diagnosis.pixels, view.bias);
    diagnosis.peter_panning = measure_gaps(
        *light, pixels_of(diagnosis.causes, Label::peter_panning), view.frustum, resolution);
    return diagnosis;
}

} // namespace gnomon::analysis
