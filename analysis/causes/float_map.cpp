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
    const Footprint footprint{rule.traits, rule.edge(), resolution};
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
                        const std::shared_ptr<const renderers::Receivers>& receivers,
                        renderers::Rasterizer& rasterizer)
{
    const scene::Job floats = with_floats(job);
    const methods::LookupTraits promised = methods::traits(job);
    if (can_derive_unbiased(job, view) && !promised.interpolates()) {
        // Where the receivers are in the map does not depend on its format.
        const renderers::MapRequest rows{.rows = rows_of(job, view, lookup, pixels)};
        return {{}, rasterizer.draw_map(floats, view, rows)->depths()};
    }
    const scene::View unbiased = without_bias(view);
    const renderers::Drawn drawn{receivers,
                                 renderers::draw_filtered_map(rasterizer, floats, unbiased)};
    FloatMap map{rasterizer.look_up({drawn, floats, unbiased}), {}};
    if (promised.has_fractions() || promised.has_one_tap()) {
        map.depths = drawn.map->map().depths();
    }
    return map;
}

FloatLookups look_up_floats(const scene::Job& job, const scene::View& view,
                            const std::shared_ptr<const renderers::Receivers>& receivers,
                            renderers::Rasterizer& rasterizer)
{
    const scene::Job floats = with_floats(job);
    const auto look_up = [&](const scene::View& biased) {
        const renderers::Drawn drawn{
            receivers, renderers::draw_filtered_map(rasterizer, floats, biased,
                                                    renderers::FilteredContent::float32)};
        return rasterizer.look_up({drawn, floats, biased});
    };
    scene::LookupLayers biased = look_up(view);
    return {std::move(biased), look_up(without_bias(view))};
}

} // namespace gnomon::analysis
