#pragma once

#include "scene/job/sweep/sweep_space.hpp"

#include <string>

namespace gnomon::scene {

/// The axes' values at a point, the case's name first: "noon, shadow_map.resolution 512".
/// @param with_bias  also the constant bias.
[[nodiscard]] std::string point_text(const SweepSpace& space, const SweepPoint& point,
                                     bool with_bias);

} // namespace gnomon::scene
