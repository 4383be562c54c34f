#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"

#include <limits>

namespace gnomon::scene {

/// The distances ζ from the light's camera of what lies within a map's sides.
struct ClippedRange {
    double nearest_m = std::numeric_limits<double>::infinity();
    double farthest_m = -std::numeric_limits<double>::infinity();
    /// Largest sum of the absolute terms of ζ there: what float32 rounds ζ by is relative to it.
    double largest_terms_m = 0;

    [[nodiscard]] bool empty() const { return !(nearest_m <= farthest_m); }
};

/// The range of ζ of all triangles, clipped to the four sides of the frustum's map and to nothing
/// else: not to near and far, nor by the objects' roles.
///
/// The sides are those of `light_clip_from_world`, the float32 matrix, moved outwards by what GL's
/// own arithmetic may err: of a point that GL finds inside, none is left out. They imply ζ >= 0 for
/// a spot, up to the same rounding.
/// @param frustum  with its matrices composed; near and far do not matter.
/// @return  `empty()` if no triangle reaches between the sides.
[[nodiscard]] ClippedRange clipped_range(const LightFrustum& frustum, const TriangleScene& scene);

} // namespace gnomon::scene
