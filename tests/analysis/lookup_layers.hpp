#pragma once

#include "scene/pixels/pixel_layers.hpp"

#include <vector>

namespace gnomon::analysis {

/// Samples as a lookup of one row.
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
