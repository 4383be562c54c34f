#include "scene/import_polygon.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cstddef>

namespace gnomon::scene {

namespace {

/// A corner of the polygon, projected so that the polygon turns counter-clockwise.
struct ProjectedCorner {
    std::uint32_t index = 0;
    Vec2d position;
};

double twice_area(const ProjectedCorner& a, const ProjectedCorner& b, const ProjectedCorner& c)
{
    const Vec2d ab = b.position - a.position;
    const Vec2d ac = c.position - a.position;
    return ab.x * ac.y - ab.y * ac.x;
}

/// Newell's normal: twice the area of the polygon's shadow on each coordinate plane.
Vec3d area_vector(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon)
{
    const Vec3d origin{vertices[polygon[0]]};
    Vec3d sum{0};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        sum += glm::cross(Vec3d{vertices[polygon[i]]} - origin,
                          Vec3d{vertices[polygon[i + 1]]} - origin);
    }
    return sum;
}

std::vector<ProjectedCorner> projected(std::span<const Vec3f> vertices,
                                       std::span<const std::uint32_t> polygon)
{
    const Vec3d area = area_vector(vertices, polygon);
    const Vec3d size = glm::abs(area);
    const int dropped = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int first = (dropped + 1) % 3;
    int second = (dropped + 2) % 3;
    if (area[dropped] < 0) {
        std::swap(first, second);
    }
    std::vector<ProjectedCorner> corners;
    corners.reserve(polygon.size());
    for (const std::uint32_t index : polygon) {
        const Vec3d position{vertices[index]};
        corners.push_back({index, {position[first], position[second]}});
    }
    return corners;
}

/// Whether corner `i` can be cut off: it is convex, and no other corner lies in the cut triangle.
bool is_ear(const std::vector<ProjectedCorner>& corners, std::size_t i)
{
    const std::size_t n = corners.size();
    const ProjectedCorner& a = corners[(i + n - 1) % n];
    const ProjectedCorner& b = corners[i];
    const ProjectedCorner& c = corners[(i + 1) % n];
    if (!(twice_area(a, b, c) > 0)) {
        return false;
    }
    for (const ProjectedCorner& p : corners) {
        // Polygons with holes pass twice through the ends of the bridge.
        const bool is_corner =
            p.position == a.position || p.position == b.position || p.position == c.position;
        if (!is_corner && twice_area(a, b, p) >= 0 && twice_area(b, c, p) >= 0 &&
            twice_area(c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

/// The corner to cut off next. Flat corners come last: their neighbours may need them.
std::size_t next_cut(const std::vector<ProjectedCorner>& corners)
{
    const std::size_t n = corners.size();
    for (std::size_t i = 1; i <= n; ++i) {
        if (is_ear(corners, i % n)) {
            return i % n;
        }
    }
    for (std::size_t i = 1; i <= n; ++i) {
        if (twice_area(corners[(i + n - 1) % n], corners[i % n], corners[(i + 1) % n]) == 0) {
            return i % n;
        }
    }
    return 1;
}

} // namespace

void triangulate(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon,
                 std::vector<TriangleIndices>& triangles)
{
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return;
    }
    std::vector<ProjectedCorner> corners = projected(vertices, polygon);
    while (corners.size() > 3) {
        const std::size_t n = corners.size();
        const std::size_t i = next_cut(corners);
        triangles.push_back(
            {corners[(i + n - 1) % n].index, corners[i].index, corners[(i + 1) % n].index});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    }
    triangles.push_back({corners[0].index, corners[1].index, corners[2].index});
}

} // namespace gnomon::scene
