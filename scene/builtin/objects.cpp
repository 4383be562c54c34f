#include "scene/builtin/objects.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace gnomon::scene {

namespace {

using Corners = std::array<std::uint32_t, 3>;

[[nodiscard]] std::uint32_t as_index(std::size_t i)
{
    return static_cast<std::uint32_t>(i);
}

[[nodiscard]] double twice_area(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Collinear corners are flat, not ears, even if rounding bends them a little. The smallest ear of
// an outline here has about 1e-4 m².
constexpr double flat_area_m2 = 1e-9;

/// True if the triangle turns left and holds no other corner of the remaining outline.
[[nodiscard]] bool is_ear(std::span<const Vec2d> outline, const std::vector<std::uint32_t>& rest,
                          const Corners& t)
{
    const auto& [a, b, c] = t;
    if (twice_area(outline[a], outline[b], outline[c]) < flat_area_m2) {
        return false;
    }
    return std::none_of(rest.begin(), rest.end(), [&](std::uint32_t i) {
        return i != a && i != b && i != c &&
               twice_area(outline[a], outline[b], outline[i]) > -flat_area_m2 &&
               twice_area(outline[b], outline[c], outline[i]) > -flat_area_m2 &&
               twice_area(outline[c], outline[a], outline[i]) > -flat_area_m2;
    });
}

/// Ear clipping that always cuts along the shortest diagonal, which keeps slivers away.
[[nodiscard]] std::vector<Corners> triangulate(std::span<const Vec2d> outline)
{
    std::vector<std::uint32_t> rest(outline.size());
    std::iota(rest.begin(), rest.end(), 0U);
    std::vector<Corners> triangles;
    while (rest.size() > 2) {
        std::size_t best = rest.size();
        Corners best_ear{};
        double best_length_m = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < rest.size(); ++i) {
            const Corners ear{rest[(i + rest.size() - 1) % rest.size()], rest[i],
                              rest[(i + 1) % rest.size()]};
            const double length_m = glm::distance(outline[ear[0]], outline[ear[2]]);
            if (length_m < best_length_m && is_ear(outline, rest, ear)) {
                best = i;
                best_ear = ear;
                best_length_m = length_m;
            }
        }
        assert(best < rest.size() && "the outline crosses itself or runs clockwise");
        triangles.push_back(best_ear);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return triangles;
}

} // namespace

Mesh make_quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

Mesh make_ground(const Vec2d& lower, const Vec2d& upper, double y_m)
{
    return make_quad({lower.x, y_m, upper.y}, {upper.x, y_m, upper.y}, {upper.x, y_m, lower.y},
                     {lower.x, y_m, lower.y});
}

Mesh make_box(const Vec3d& lower, const Vec3d& upper)
{
    Mesh mesh;
    for (const double z : {lower.z, upper.z}) {
        for (const double y : {lower.y, upper.y}) {
            for (const double x : {lower.x, upper.x}) {
                mesh.vertices.emplace_back(x, y, z);
            }
        }
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1},  // −z
                      {4, 5, 7}, {4, 7, 6},  // +z
                      {0, 4, 6}, {0, 6, 2},  // −x
                      {1, 3, 7}, {1, 7, 5},  // +x
                      {0, 1, 5}, {0, 5, 4},  // −y
                      {2, 6, 7}, {2, 7, 3}}; // +y
    return mesh;
}

Mesh make_revolution(std::span<const Vec2d> profile, int slices)
{
    assert(profile.size() >= 3 && slices >= 3);
    const auto slice_count = static_cast<std::size_t>(slices);
    const std::size_t ring_count = profile.size() - 2;
    Mesh mesh;
    for (std::size_t ring = 1; ring <= ring_count; ++ring) {
        for (std::size_t slice = 0; slice < slice_count; ++slice) {
            const double angle_rad =
                2 * std::numbers::pi * static_cast<double>(slice) / static_cast<double>(slices);
            mesh.vertices.emplace_back(profile[ring].x * std::sin(angle_rad), profile[ring].y,
                                       profile[ring].x * std::cos(angle_rad));
        }
    }
    const auto bottom = as_index(mesh.vertices.size());
    mesh.vertices.emplace_back(0.0, profile.front().y, 0.0);
    mesh.vertices.emplace_back(0.0, profile.back().y, 0.0);

    for (std::size_t slice = 0; slice < slice_count; ++slice) {
        const auto at = [&](std::size_t ring, std::size_t step) {
            return as_index(ring * slice_count + (slice + step) % slice_count);
        };
        mesh.triangles.push_back({bottom, at(0, 1), at(0, 0)});
        for (std::size_t ring = 0; ring + 1 < ring_count; ++ring) {
            mesh.triangles.push_back({at(ring, 0), at(ring, 1), at(ring + 1, 1)});
            mesh.triangles.push_back({at(ring, 0), at(ring + 1, 1), at(ring + 1, 0)});
        }
        mesh.triangles.push_back({at(ring_count - 1, 0), at(ring_count - 1, 1), bottom + 1});
    }
    return mesh;
}

Mesh make_sphere(const Vec3d& centre, double radius_m, int slices, int stacks)
{
    std::vector<Vec2d> profile{{0.0, -radius_m}};
    for (int stack = 1; stack < stacks; ++stack) {
        const double latitude_rad = std::numbers::pi * (static_cast<double>(stack) / stacks - 0.5);
        profile.emplace_back(radius_m * std::cos(latitude_rad), radius_m * std::sin(latitude_rad));
    }
    profile.emplace_back(0.0, radius_m);
    Mesh mesh = make_revolution(profile, slices);
    move_by(mesh, centre);
    return mesh;
}

Mesh make_cylinder(const Vec3d& base, double radius_m, double height_m, int slices)
{
    const std::array<Vec2d, 4> profile{Vec2d{0.0, 0.0}, Vec2d{radius_m, 0.0},
                                       Vec2d{radius_m, height_m}, Vec2d{0.0, height_m}};
    Mesh mesh = make_revolution(profile, slices);
    move_by(mesh, base);
    return mesh;
}

Mesh make_prism(std::span<const Vec2d> outline, double lower_z_m, double upper_z_m)
{
    const auto corner_count = as_index(outline.size());
    Mesh mesh;
    for (const double z : {lower_z_m, upper_z_m}) {
        for (const Vec2d& corner : outline) {
            mesh.vertices.emplace_back(corner.x, corner.y, z);
        }
    }
    for (const auto& [a, b, c] : triangulate(outline)) {
        mesh.triangles.push_back({c, b, a});
        mesh.triangles.push_back({a + corner_count, b + corner_count, c + corner_count});
    }
    for (std::uint32_t i = 0; i < corner_count; ++i) {
        const std::uint32_t j = (i + 1) % corner_count;
        mesh.triangles.push_back({i, j, j + corner_count});
        mesh.triangles.push_back({i, j + corner_count, i + corner_count});
    }
    return mesh;
}

std::vector<Vec2d> arcade_outline(const ArcadeShape& shape)
{
    const double half_length_m = 0.5 * shape.spacing_m * shape.arch_count;
    const double pier_m = 0.5 * shape.spacing_m - shape.arch_radius_m;
    std::vector<Vec2d> outline{{-half_length_m - pier_m, shape.springing_y_m}};
    for (int arch = 0; arch < shape.arch_count; ++arch) {
        const double middle_m = -half_length_m + shape.spacing_m * (arch + 0.5);
        for (int i = 0; i <= shape.arch_segments; ++i) {
            const double angle_rad = std::numbers::pi * i / shape.arch_segments;
            // The springing itself is exact: sin(pi) would lift it off the pier's foot.
            const bool springing = i == 0 || i == shape.arch_segments;
            const double rise_m = springing ? 0.0 : shape.arch_radius_m * std::sin(angle_rad);
            outline.emplace_back(middle_m - shape.arch_radius_m * std::cos(angle_rad),
                                 shape.springing_y_m + rise_m);
        }
    }
    outline.emplace_back(half_length_m + pier_m, shape.springing_y_m);
    outline.emplace_back(half_length_m + pier_m, shape.top_y_m);
    outline.emplace_back(-half_length_m - pier_m, shape.top_y_m);
    return outline;
}

void move_by(Mesh& mesh, const Vec3d& offset_m)
{
    for (Vec3d& vertex : mesh.vertices) {
        vertex += offset_m;
    }
}

void turn_quarter(Mesh& mesh)
{
    for (Vec3d& vertex : mesh.vertices) {
        vertex = {vertex.z, vertex.y, -vertex.x};
    }
}

void turn_about_y(Mesh& mesh, double angle_rad)
{
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    for (Vec3d& vertex : mesh.vertices) {
        vertex = {c * vertex.x + s * vertex.z, vertex.y, c * vertex.z - s * vertex.x};
    }
}

void flip(Mesh& mesh)
{
    for (auto& triangle : mesh.triangles) {
        std::swap(triangle[1], triangle[2]);
    }
}

void append(Mesh& whole, const Mesh& part)
{
    const auto first = as_index(whole.vertices.size());
    whole.vertices.insert(whole.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles) {
        whole.triangles.push_back({a + first, b + first, c + first});
    }
}

} // namespace gnomon::scene
