#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>

namespace gnomon::tests {

/// The view with four maps in place of its one: its quarters, of half as many texels a side, lower
/// left, lower right, upper left, upper right.
[[nodiscard]] scene::View in_quadrants(scene::View view);

/// The texel of the one map that a texel of a quarter is.
/// @param resolution_texels  of the quarter.
[[nodiscard]] scene::Texel texel_of_whole(const scene::Texel& texel, int resolution_texels);

/// Random tilted quadrangles over a ground, each over one quarter of it: GL clips at a map's edges,
/// which would round. Sides are powers of two, places and slopes multiples of 1/8, so that matrices
/// of quarters of their map, clip positions of vertices, interpolated depths and rays through
/// texels have no rounding, whatever the order of their sums. Some only cast shadows.
[[nodiscard]] scene::SceneFile tilted_quadrangles(std::uint32_t seed);

/// A job that shows them from above under a sun overhead, with one map of 256 texels a side: what
/// GL interpolates of receivers, and their coordinates on the map, have no rounding either.
[[nodiscard]] scene::Job looking_at_quadrangles();
/// The same from aside.
[[nodiscard]] scene::Job looking_at_quadrangles_from_aside();

} // namespace gnomon::tests
