#include "mesh_checks.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace gnomon::scene::test {

namespace {

using Point = std::tuple<float, float, float>;

[[nodiscard]] Point as_point(const Vec3f& v)
{
    return {v.x, v.y, v.z};
}

/// A triangle with its plane, turned so that both sides have the same one.
struct PlanarTriangle {
    std::uint32_t index = 0;
    std::array<Vec2d, 3> corners; ///< projected along the normal's largest axis
    Vec2d lower;
    Vec2d upper;
    Vec3d normal;
    double offset_m = 0;
};

[[nodiscard]] int largest_axis(const Vec3d& v)
{
    const Vec3d size = glm::abs(v);
    if (size.x >= size.y && size.x >= size.z) {
        return 0;
    }
    return size.y >= size.z ? 1 : 2;
}

[[nodiscard]] PlanarTriangle make_planar(const TriangleScene& scene, std::uint32_t index)
{
    const auto corners = scene.corners(index);
    const Vec3d a{corners[0]};
    PlanarTriangle t;
    t.index = index;
    t.normal = glm::normalize(glm::cross(Vec3d{corners[1]} - a, Vec3d{corners[2]} - a));
    const int axis = largest_axis(t.normal);
    t.normal *= t.normal[axis] < 0 ? -1.0 : 1.0;
    t.offset_m = glm::dot(t.normal, a);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d p{corners[i]};
        t.corners[i] = {p[(axis + 1) % 3], p[(axis + 2) % 3]};
    }
    t.lower = glm::min(glm::min(t.corners[0], t.corners[1]), t.corners[2]);
    t.upper = glm::max(glm::max(t.corners[0], t.corners[1]), t.corners[2]);
    return t;
}

// Triangles that only share an edge or a corner meet within float32's rounding of coordinates below
// 50 m, 2^-19 m = 2e-6 m. Visible overlaps are far wider.
constexpr double contact_m = 1e-5;
constexpr double same_plane = 1e-5;

/// True if a line along one of `a`'s edges has `a` on one side and `b` on the other.
[[nodiscard]] bool separates(const PlanarTriangle& a, const PlanarTriangle& b)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2d edge = a.corners[(i + 1) % 3] - a.corners[i];
        const Vec2d side = glm::normalize(Vec2d{-edge.y, edge.x});
        const double apex = glm::dot(side, a.corners[(i + 2) % 3] - a.corners[i]);
        const double sign = apex < 0 ? -1.0 : 1.0;
        double nearest_m = -1e300;
        for (const Vec2d& corner : b.corners) {
            nearest_m = std::max(nearest_m, sign * glm::dot(side, corner - a.corners[i]));
        }
        if (nearest_m < contact_m) {
            return true;
        }
    }
    return false;
}

[[nodiscard]] bool overlap(const PlanarTriangle& a, const PlanarTriangle& b)
{
    const bool boxes_meet = a.lower.x < b.upper.x && b.lower.x < a.upper.x &&
                            a.lower.y < b.upper.y && b.lower.y < a.upper.y;
    return boxes_meet && glm::length(a.normal - b.normal) < same_plane && !separates(a, b) &&
           !separates(b, a);
}

/// Triangles with similar normals, so that coplanar ones are neighbours when sorted by offset.
using NormalCell = std::array<long, 3>;
using Cells = std::map<NormalCell, std::vector<PlanarTriangle>>;

[[nodiscard]] Cells sort_by_plane(const TriangleScene& scene)
{
    // Cells are centred on multiples of 1/1000: the axes' own normals lie in the middle of one.
    Cells cells;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const PlanarTriangle t = make_planar(scene, i);
        const Vec3d scaled = 1000.0 * t.normal;
        cells[{std::lround(scaled.x), std::lround(scaled.y), std::lround(scaled.z)}].push_back(t);
    }
    for (auto& [cell, triangles] : cells) {
        std::sort(triangles.begin(), triangles.end(),
                  [](const PlanarTriangle& a, const PlanarTriangle& b) {
                      return a.offset_m < b.offset_m;
                  });
    }
    return cells;
}

} // namespace

EdgeReport check_edges(const TriangleScene& scene, const Object& object)
{
    std::map<std::pair<Point, Point>, int> uses;
    EdgeReport report;
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        const auto corners = scene.corners(object.first_triangle + i);
        for (std::size_t k = 0; k < 3; ++k) {
            ++uses[{as_point(corners[k]), as_point(corners[(k + 1) % 3])}];
        }
        report.signed_volume_m3 +=
            glm::dot(Vec3d{corners[0]}, glm::cross(Vec3d{corners[1]}, Vec3d{corners[2]})) / 6;
    }
    for (const auto& [edge, count] : uses) {
        const auto partner = uses.find({edge.second, edge.first});
        if (count != 1 || partner == uses.end() || partner->second != 1) {
            ++report.unmatched_edges;
        }
    }
    return report;
}

std::vector<Overlap> coplanar_overlaps(const TriangleScene& scene)
{
    std::vector<Overlap> overlaps;
    for (const auto& [cell, triangles] : sort_by_plane(scene)) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = i + 1;
                 j < triangles.size() && triangles[j].offset_m - triangles[i].offset_m < same_plane;
                 ++j) {
                if (overlap(triangles[i], triangles[j])) {
                    overlaps.push_back({triangles[i].index, triangles[j].index});
                }
            }
        }
    }
    return overlaps;
}

std::string triangle_name(const TriangleScene& scene, std::uint32_t triangle)
{
    return scene.objects[scene.object_of(triangle)].name + "/" + std::to_string(triangle);
}

} // namespace gnomon::scene::test
