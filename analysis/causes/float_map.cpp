#include "analysis/causes/float_map.hpp"

#include "analysis/lookup/deciding_samples.hpp"
#include "analysis/lookup/footprint.hpp"
#include "methods/depth/filters.hpp"

#include <algorithm>

namespace gnomon::analysis {

namespace {

/// The rows that the pixels' taps are in; at least one.
scene::TexelRows rows_of(const scene::Job& job, const scene::LookupLayers& lookup,
                         std::span<const std::size_t> pixels)
{
    const int resolution = job.shadow_map.resolution_texels;
    const Footprint footprint{job.lookup, resolution};
    int first = resolution - 1;
    int last = 0;
    for (const std::size_t pixel : pixels) {
        footprint.visit_taps(lookup.texels[pixel], [&](const Tap& tap) {
            if (tap.is_inside) {
                first = std::min(first, tap.texel.y);
                last = std::max(last, tap.texel.y);
            }
        });
    }
    first = std::min(first, last);
    return {first, last - first + 1};
}

} // namespace

FloatMap draw_float_map(const scene::Job& job, const scene::View& view,
                        const scene::LookupLayers& lookup, std::span<const std::size_t> pixels,
                        const Renderers& renderers)
{
    const methods::FilterPromises& promised = methods::filter_promises(job.lookup.filter);
    if (can_derive_unbiased(job, view) && !promised.interpolates()) {
        // Where the receivers are in the map does not depend on its format.
        return {{}, renderers.read_float_depths(job, view, rows_of(job, lookup, pixels))};
    }
    scene::Job floats = job;
    floats.shadow_map.depth_format = {scene::DepthFormat::Kind::d32f, 32};
    scene::View unbiased = view;
    unbiased.bias = {};
    renderers.draw_shadow_map(floats, unbiased);
    FloatMap map{renderers.look_up(floats, unbiased), {}};
    if (promised.has_fractions() || promised.has_one_tap()) {
        map.depths = renderers.read_map_depths();
    }
    return map;
}

} // namespace gnomon::analysis
