#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"

#include <functional>

namespace gnomon::scene {

/// Calls `visit` with the corners of every receiving triangle's part inside the camera's view (its
/// four sides and the receivers' near plane), in world space [m]. Occlusion is ignored.
void visit_visible_corners(const TriangleScene& scene, const Camera& camera, ImageSize image,
                           const std::function<void(const Vec3d&)>& visit);

} // namespace gnomon::scene
