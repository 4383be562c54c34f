#include "analysis/causes/float_map.hpp"

#include "analysis/lookup/deciding_samples.hpp"
#include "analysis/lookup/footprint.hpp"
#include "methods/job_method.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The rows that the pixels' taps are in; at least one.
scene::TexelRows rows_of(const scene::Job& job, const scene::View& view,
                         const scene::LookupLayers& lookup, std::span<const std::size_t> pixels)
{
    const int resolution = job.shadow_map.resolution_texels;
    const LookupRule rule = lookup_rule(job, view);
    const Footprint footprint{rule.promises, rule.edge(), resolution};
    int first = resolution - 1;
    int last = 0;
    for (const std::size_t pixel : pixels) {
        footprint.visit_taps(lookup.at(pixel), [&](const Tap& tap) {
            if (tap.is_inside) {
                first = std::min(first, tap.texel.y);
                last = std::max(last, tap.texel.y);
            }
        });
    }
    first = std::min(first, last);
    return {first, last - first + 1};
}

scene::Job with_floats(scene::Job job)
{
    job.shadow_map.depth_format = scene::float_depth_format;
    return job;
}

/// At the receiver itself.
scene::View without_bias(scene::View view)
{
    view.bias = {};
    return view;
}

} // namespace

FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                        const scene::LookupLayers& lookup, std::span<const std::size_t> pixels,
                        const Renderers& renderers)
{
    const methods::Promises promised = methods::promises(job);
    if (can_derive_unbiased(job, view) && !promised.interpolates()) {
        // Where the receivers are in the map does not depend on its format.
        return {{}, renderers.read_float_depths(job, view, rows_of(job, view, lookup, pixels))};
    }
    const scene::Job floats = with_floats(job);
    const scene::View unbiased = without_bias(view);
    renderers.draw_shadow_map(floats, unbiased);
    FloatMap map{renderers.look_up(floats, unbiased), {}};
    if (promised.has_fractions() || promised.has_one_tap()) {
        map.depths = renderers.read_map_depths();
    }
    return map;
}

FloatLookups look_up_floats(const scene::Job& job, const scene::View& view,
                            const Renderers& renderers)
{
    const scene::Job floats = with_floats(job);
    const auto look_up = [&](const scene::View& biased) {
        renderers.draw_shadow_map(floats, biased);
        if (renderers.prefilter_map) {
            renderers.prefilter_map(floats, biased, FilteredContent::float32);
        }
        return renderers.look_up(floats, biased);
    };
    scene::LookupLayers biased = look_up(view);
    return {std::move(biased), look_up(without_bias(view))};
}

} // namespace gnomon::analysis
