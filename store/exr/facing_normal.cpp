#include "store/exr/facing_normal.hpp"

#include "scene/camera/camera.hpp"
#include "scene/geometry/vertex_normals.hpp"

#include <glm/geometric.hpp>

#include <cstdint>

namespace gnomon::store {

using scene::Vec3d;

Vec3d facing_normal(const analysis::Comparison& comparison, int x, int y)
{
    if (comparison.evaluation) {
        return Vec3d{comparison.evaluation->normal(x, y)};
    }
    const auto [a, b, c] = comparison.triangles->corners(comparison.receivers.triangle(x, y));
    const Vec3d origin{a};
    const Vec3d across = glm::cross(Vec3d{b} - origin, Vec3d{c} - origin);
    const double twice_area = glm::length(across);
    const Vec3d normal = twice_area > 0 ? across / twice_area : Vec3d{0, 1, 0};
    const scene::Ray ray = scene::pixel_ray(comparison.view.camera, comparison.view.image, x, y);
    return glm::dot(normal, ray.direction) > 0 ? -normal : normal;
}

Vec3d facing_vertex_normal(const analysis::Comparison& comparison, int x, int y, const Vec3d& point)
{
    const std::uint32_t triangle = comparison.receivers.triangle(x, y);
    const Vec3d normal = scene::vertex_normal_at(*comparison.triangles, triangle, point);
    const double side = glm::dot(normal, facing_normal(comparison, x, y));
    return side < 0 ? -normal : normal;
}

} // namespace gnomon::store
