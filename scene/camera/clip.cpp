#include "scene/camera/clip.hpp"

#include "scene/camera/polygon_clip.hpp"

#include <glm/geometric.hpp>

#include <array>

namespace gnomon::scene {
namespace {

std::array<HalfSpace, 5> view_planes(const Camera& camera, ImageSize image, double near_m)
{
    const double half_height = camera.half_height;
    const double half_width = half_height * image.width_px / image.height_px;
    const auto side = [&](const Vec3d& axis, double half) {
        const bool perspective = camera.projection == Projection::perspective;
        const Vec3d normal = perspective ? half * camera.forward - axis : -axis;
        return HalfSpace{normal, -glm::dot(normal, camera.eye) + (perspective ? 0.0 : half)};
    };
    return {side(camera.right, half_width), side(-camera.right, half_width),
            side(camera.up, half_height), side(-camera.up, half_height),
            HalfSpace{camera.forward, -glm::dot(camera.forward, camera.eye) - near_m}};
}

} // namespace

void visit_visible_corners(const TriangleScene& scene, const Camera& camera, ImageSize image,
                           const std::function<void(const Vec3d&)>& visit)
{
    const auto planes = view_planes(camera, image, receiver_near_m(scene.bounds()));
    PolygonClipper clipper;
    for (const TriangleRange& range : receiving_ranges(scene)) {
        for (std::uint32_t i = 0; i < range.count; ++i) {
            const auto [a, b, c] = scene.corners(range.first + i);
            const std::array<Vec3d, 3> triangle{Vec3d{a}, Vec3d{b}, Vec3d{c}};
            for (const Vec3d& corner : clipper.clip(triangle, planes)) {
                visit(corner);
            }
        }
    }
}

} // namespace gnomon::scene
