#pragma once

#include "analysis/lookup/lookup_rule.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::analysis {

/// The rule of lookups with this filter in a depth map.
inline LookupRule rule_of(scene::Filter filter, scene::Outside outside = scene::Outside::lit,
                          bool reversed = false, float slope = 0)
{
    return {methods::filter_traits(filter), outside, reversed, slope};
}

/// The footprint of a lookup with this filter.
inline Footprint footprint_of(scene::Filter filter, scene::Outside outside, int resolution_texels)
{
    return {methods::filter_traits(filter), map_edge(outside, false), resolution_texels};
}

/// The samples as a lookup of one row.
inline scene::LookupLayers layers_of(const std::vector<scene::LookupSample>& samples)
{
    scene::LookupLayers layers{
        scene::Image<scene::LookupSample>{{static_cast<int>(samples.size()), 1}}};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        layers.samples[i] = samples[i];
    }
    return layers;
}

} // namespace gnomon::analysis
