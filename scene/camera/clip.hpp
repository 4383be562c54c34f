#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <glm/geometric.hpp>

#include <functional>
#include <span>
#include <vector>

namespace gnomon::scene {

/// A half space: inside where normal·p + offset >= 0.
struct HalfSpace {
    Vec3d normal;
    double offset = 0;

    [[nodiscard]] double signed_distance(const Vec3d& p) const
    {
        return glm::dot(normal, p) + offset;
    }
};

/// Clips convex polygons against half spaces. Reuse one object: it keeps its buffers.
class PolygonClipper {
public:
    /// The corners of the part inside every half space, in order; empty if nothing is inside.
    ///
    /// Corners lie on the polygon's edges and the planes up to a few 2^-53 of the coordinates and
    /// of the sums of a plane's terms. The span is valid until the next call.
    [[nodiscard]] std::span<const Vec3d> clip(std::span<const Vec3d> polygon,
                                              std::span<const HalfSpace> half_spaces);

private:
    std::vector<Vec3d> polygon_;
    std::vector<Vec3d> clipped_;
};

/// Calls `visit` with the corners of every receiving triangle's part inside the camera's view (its
/// four sides and the receivers' near plane), in world space [m]. Occlusion is ignored.
void visit_visible_corners(const TriangleScene& scene, const Camera& camera, ImageSize image,
                           const std::function<void(const Vec3d&)>& visit);

} // namespace gnomon::scene
