#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::scene {

/// A segment between two points [m].
using Edge = std::array<Vec3d, 2>;

/// The edges of receiving triangles at which what the camera sees may end: those that are of two
/// triangles on one side of the plane through the eye and the edge, and those that are of any other
/// number than two. Decided in double: where the side of a corner is not certain, the edge is one.
[[nodiscard]] std::vector<Edge> silhouette_edges(const TriangleScene& scene, const Camera& camera);

/// Which pixels show an edge: 1 where one crosses the pixel's square, grown by a margin to each
/// side, no farther from the camera's plane than the pixel says.
/// @param margin_px   of what a rasteriser may snap, for one.
/// @param near_m      What is nearer to the camera's plane is not seen.
/// @param farthest_m  along the camera's axis; its size is the image's.
[[nodiscard]] Image<std::uint8_t> pixels_of_edges(std::span<const Edge> edges, const Camera& camera,
                                                  double margin_px, double near_m,
                                                  const Image<double>& farthest_m);

} // namespace gnomon::scene
