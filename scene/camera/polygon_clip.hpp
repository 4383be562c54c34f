#pragma once

#include "scene/vec.hpp"

#include <glm/geometric.hpp>

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

/// Clips convex polygons against half spaces; one object for many polygons saves their allocations.
class PolygonClipper {
public:
    /// The corners of the polygon's part inside every half space, in order; empty where there is
    /// none.
    ///
    /// Every corner lies on the polygon's edges and the planes up to a few 2^-53 of the coordinates
    /// and of the sums of a plane's terms. The span is valid until the next call.
    [[nodiscard]] std::span<const Vec3d> clip(std::span<const Vec3d> polygon,
                                              std::span<const HalfSpace> half_spaces);

private:
    std::vector<Vec3d> polygon_;
    std::vector<Vec3d> clipped_;
};

} // namespace gnomon::scene
