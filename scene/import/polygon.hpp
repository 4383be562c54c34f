#pragma once

#include "scene/import/stream.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene {

/// Appends the n − 2 triangles of a polygon, wound as the polygon is.
///
/// Ears are clipped in the plane of the coordinates in which the polygon is largest, never across
/// a vertex that lies on the cut: a convex polygon becomes the fan of its first corner, and a
/// simple one, convex or not, is covered once. Of a polygon that crosses itself any triangles come.
/// One of 100,000 corners takes 2 s.
/// @param vertices  positions [m].
/// @param polygon   n >= 3 indices into `vertices`.
void triangulate(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon,
                 std::vector<TriangleIndices>& triangles);

} // namespace gnomon::scene
