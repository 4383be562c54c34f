#include "scene/view_clip.hpp"

#include <glm/geometric.hpp>

#include <array>
#include <vector>

namespace gnomon::scene {
namespace {

/// Inside where normal·p + offset >= 0.
struct Plane {
    Vec3d normal;
    double offset = 0;

    [[nodiscard]] double signed_distance(const Vec3d& p) const
    {
        return glm::dot(normal, p) + offset;
    }
};

using Polygon = std::vector<Vec3d>;

std::array<Plane, 5> view_planes(const Camera& camera, ImageSize image, double near_m)
{
    const double half_height = camera.half_height;
    const double half_width = half_height * image.width_px / image.height_px;
    const auto side = [&](const Vec3d& axis, double half) {
        const bool perspective = camera.projection == Projection::perspective;
        const Vec3d normal = perspective ? half * camera.forward - axis : -axis;
        return Plane{normal, -glm::dot(normal, camera.eye) + (perspective ? 0.0 : half)};
    };
    return {side(camera.right, half_width), side(-camera.right, half_width),
            side(camera.up, half_height), side(-camera.up, half_height),
            Plane{camera.forward, -glm::dot(camera.forward, camera.eye) - near_m}};
}

/// Sutherland–Hodgman against one plane.
void clip(const Polygon& polygon, const Plane& plane, Polygon& result)
{
    result.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double at_a = plane.signed_distance(a);
        const double at_b = plane.signed_distance(b);
        if (at_a >= 0) {
            result.push_back(a);
        }
        if ((at_a >= 0) != (at_b >= 0)) {
            result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
        }
    }
}

} // namespace

void visit_visible_corners(const TriangleScene& scene, const Camera& camera, ImageSize image,
                           const std::function<void(const Vec3d&)>& visit)
{
    const auto planes = view_planes(camera, image, receiver_near_m(scene.bounds()));
    Polygon polygon;
    Polygon clipped;
    for (const TriangleRange& range : receiving_ranges(scene)) {
        for (std::uint32_t i = 0; i < range.count; ++i) {
            const auto corners = scene.corners(range.first + i);
            polygon.assign(corners.begin(), corners.end());
            for (const Plane& plane : planes) {
                clip(polygon, plane, clipped);
                polygon.swap(clipped);
            }
            for (const Vec3d& corner : polygon) {
                visit(corner);
            }
        }
    }
}

} // namespace gnomon::scene
