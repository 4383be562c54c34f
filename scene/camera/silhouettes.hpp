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

/// The possible silhouette edges of receiving triangles: edges whose two triangles lie on one side
/// of the plane through the eye and the edge, and edges that do not have exactly two triangles.
/// Decided in double; an uncertain edge counts as a silhouette.
[[nodiscard]] std::vector<Edge> silhouette_edges(const TriangleScene& scene, const Camera& camera);

/// Marks pixels that show an edge: 1 if an edge crosses the pixel's square, grown by the margin, no
/// farther from the camera's plane than `farthest_m`.
/// @param margin_px   for example the distance by which a rasteriser may snap.
/// @param near_m      Nothing nearer to the camera's plane is seen.
/// @param farthest_m  along the camera's axis; its size is the image's.
[[nodiscard]] Image<std::uint8_t> pixels_of_edges(std::span<const Edge> edges, const Camera& camera,
                                                  double margin_px, double near_m,
                                                  const Image<double>& farthest_m);

} // namespace gnomon::scene
