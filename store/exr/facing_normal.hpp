#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/vec.hpp"

namespace gnomon::store {

/// The unit normal of the triangle that a pixel shows, on the side that the camera sees; NaN where
/// another renderer's case does not tell that side.
/// Precondition: the pixel shows a triangle of the scene.
[[nodiscard]] scene::Vec3d facing_normal(const analysis::Comparison& comparison, int x, int y);

/// The normal interpolated from the vertices at P, unit, on the same side.
/// @param point  P [m].
/// Precondition: the pixel shows a triangle of the scene, which has normals.
[[nodiscard]] scene::Vec3d facing_vertex_normal(const analysis::Comparison& comparison, int x,
                                                int y, const scene::Vec3d& point);

} // namespace gnomon::store
