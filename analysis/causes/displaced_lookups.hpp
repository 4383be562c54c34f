#pragma once

#include "analysis/causes/cause_inputs.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Lookups that float32 displaces: around the exact uv · resolution lie other taps than GL's, as
/// happens far from the origin.
struct DisplacedLookups {
    std::vector<std::size_t> indices; ///< among the pixels in question
    std::vector<std::size_t> pixels;
    std::vector<scene::MapPoint> points; ///< the exact places of those
    std::vector<std::size_t> of_border;  ///< indices of others, where the border mode decides all
                                         ///< taps of the exact place
};

/// Finds them among the pixels.
/// @param layers  GL's lookup.
/// @param moved   `ReceiverRule::moved` of it; nullptr: it is at the receivers themselves.
[[nodiscard]] DisplacedLookups find_displaced(const CauseInputs& inputs,
                                              const scene::LookupLayers& layers,
                                              std::span<const std::size_t> pixels,
                                              const scene::Image<scene::Vec4f>* moved);

} // namespace gnomon::analysis
