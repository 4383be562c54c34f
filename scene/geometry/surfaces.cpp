#include "scene/geometry/surfaces.hpp"

#include "scene/infinity.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace gnomon::scene {
namespace {

bool meets(const std::array<Vec3f, 3>& corners, const Segment& segment)
{
    const Vec3d a{corners[0]};
    const Vec3d p = Vec3d{corners[1]} - a;
    const Vec3d q = Vec3d{corners[2]} - a;
    const Vec3d across = glm::cross(segment.direction, q);
    const double volume = glm::dot(p, across);
    if (volume == 0) {
        return false;
    }
    const Vec3d from_a = segment.start - a;
    const double u = glm::dot(from_a, across) / volume;
    const Vec3d turned = glm::cross(from_a, p);
    const double v = glm::dot(segment.direction, turned) / volume;
    const double t = glm::dot(q, turned) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < segment.end;
}

} // namespace

Box bounds_of(const TriangleScene& scene, const Object& object)
{
    Box box{Vec3d{infinity}, Vec3d{-infinity}};
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        for (const Vec3f& corner : scene.corners(object.first_triangle + i)) {
            box.lower = glm::min(box.lower, Vec3d{corner});
            box.upper = glm::max(box.upper, Vec3d{corner});
        }
    }
    return box;
}

bool meets(const TriangleScene& scene, const Object& object, const Segment& segment)
{
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        if (meets(scene.corners(object.first_triangle + i), segment)) {
            return true;
        }
    }
    return false;
}

std::vector<std::uint32_t> first_of_equals(std::span<const Vec3f> vertices)
{
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, {}, [&](std::uint32_t i) {
        return std::tuple{vertices[i].x, vertices[i].y, vertices[i].z, i};
    });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool repeats = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
        first[order[i]] = repeats ? first[order[i - 1]] : order[i];
    }
    return first;
}

std::vector<EdgeOfTriangle> receiving_edges(const TriangleScene& scene)
{
    const std::vector<std::uint32_t> merged = first_of_equals(scene.vertices);
    std::vector<EdgeOfTriangle> edges;
    for (const auto& [first, count] : receiving_ranges(scene)) {
        for (std::uint32_t t = first; t < first + count; ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& triangle = scene.triangles[t];
                const auto [a, b] =
                    std::minmax({merged[triangle[i]], merged[triangle[(i + 1) % 3]]});
                edges.push_back({a, b, merged[triangle[(i + 2) % 3]]});
            }
        }
    }
    std::ranges::sort(edges);
    const auto doubles = std::ranges::unique(edges);
    edges.erase(doubles.begin(), doubles.end());
    return edges;
}

} // namespace gnomon::scene
