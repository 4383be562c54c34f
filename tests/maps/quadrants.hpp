#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>

namespace gnomon::tests {

/// Replaces the view's map by its four quarters, each half as wide in texels: lower left, lower
/// right, upper left, upper right.
[[nodiscard]] scene::View in_quadrants(scene::View view);

/// The texel of the whole map where a quarter's texel lies.
/// @param resolution_texels  Of the quarter.
[[nodiscard]] scene::Texel texel_of_whole(const scene::Texel& texel, int resolution_texels);

/// Random tilted quadrangles over a ground. Some only cast shadows. Sides are powers of two, places
/// and slopes multiples of 1/8: matrices of the map's quarters, clip positions, interpolated depths
/// and rays through texels have no rounding, in any order of their sums. Each quadrangle lies over
/// one quarter, because clipping at a map's edge would round.
[[nodiscard]] scene::SceneFile tilted_quadrangles(std::uint32_t seed);

/// A job that shows them from above under a sun overhead, with a map of 256 × 256 texels. GL's
/// interpolation and the coordinates on the map have no rounding either.
[[nodiscard]] scene::Job looking_at_quadrangles();
/// That job with a camera from aside.
[[nodiscard]] scene::Job looking_at_quadrangles_from_aside();

} // namespace gnomon::tests
