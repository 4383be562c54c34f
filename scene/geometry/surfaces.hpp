#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Queries about whole surfaces, in double precision.
namespace gnomon::scene {

/// Box of an object's vertices; empty if it has no triangle.
[[nodiscard]] Box bounds_of(const TriangleScene& scene, const Object& object);

/// A segment start + t·direction, t in (0, end), or a ray of infinite `end`.
struct Segment {
    Vec3d start;
    Vec3d direction;
    double end = 1; ///< [direction]
};
/// Whether a triangle of the object meets the segment.
[[nodiscard]] bool meets(const TriangleScene& scene, const Object& object, const Segment& segment);

/// For each vertex, the first vertex at the same place. Coordinates have no negative zeros, so
/// equal ones are bit-equal.
[[nodiscard]] std::vector<std::uint32_t> first_of_equals(std::span<const Vec3f> vertices);

/// A triangle's edge and the opposite corner; each index is the first vertex at its place.
struct EdgeOfTriangle {
    std::uint32_t a = 0; ///< the lower
    std::uint32_t b = 0;
    std::uint32_t opposite = 0;

    friend auto operator<=>(const EdgeOfTriangle&, const EdgeOfTriangle&) = default;
};
/// The edges of receiving triangles, sorted. Triangles with the same corners, as in double-sided
/// meshes, count as one surface and give their edges once.
[[nodiscard]] std::vector<EdgeOfTriangle> receiving_edges(const TriangleScene& scene);

} // namespace gnomon::scene
