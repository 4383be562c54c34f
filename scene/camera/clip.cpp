#include "scene/camera/clip.hpp"

#include <glm/geometric.hpp>

#include <array>

namespace gnomon::scene {
namespace {

/// Sutherland–Hodgman against one half space.
void clip_against(const std::vector<Vec3d>& polygon, const HalfSpace& half_space,
                  std::vector<Vec3d>& result)
{
    result.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double at_a = half_space.signed_distance(a);
        const double at_b = half_space.signed_distance(b);
        if (at_a >= 0) {
            result.push_back(a);
        }
        if ((at_a >= 0) != (at_b >= 0)) {
            result.push_back(a + (at_a / (at_a - at_b)) * (b - a));
        }
    }
}

} // namespace

std::span<const Vec3d> PolygonClipper::clip(std::span<const Vec3d> polygon,
                                            std::span<const HalfSpace> half_spaces)
{
    polygon_.assign(polygon.begin(), polygon.end());
    for (const HalfSpace& half_space : half_spaces) {
        clip_against(polygon_, half_space, clipped_);
        polygon_.swap(clipped_);
    }
    return polygon_;
}

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
