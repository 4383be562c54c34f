#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// What is asked of surfaces as a whole, in double precision.
namespace gnomon::scene {

/// Box of an object's vertices; empty where it has no triangle.
[[nodiscard]] Box bounds_of(const TriangleScene& scene, const Object& object);

/// A segment start + t·direction, t in (0, end), or a ray of infinite `end`.
struct Segment {
    Vec3d start;
    Vec3d direction;
    double end = 1; ///< [direction]
};
/// Whether a triangle of the object meets the segment.
[[nodiscard]] bool meets(const TriangleScene& scene, const Object& object, const Segment& segment);

/// Of each vertex the first one at its place: coordinates have no negative zeros, so equal ones are
/// bit-equal.
[[nodiscard]] std::vector<std::uint32_t> first_of_equals(std::span<const Vec3f> vertices);

/// One triangle's edge, and its corner opposite to it: each the first vertex at its place.
struct EdgeOfTriangle {
    std::uint32_t a = 0; ///< the lower
    std::uint32_t b = 0;
    std::uint32_t opposite = 0;

    friend auto operator<=>(const EdgeOfTriangle&, const EdgeOfTriangle&) = default;
};
/// The edges of receiving triangles, sorted. Those of triangles with the same corners, as of a mesh
/// with both faces, once: they are one surface.
[[nodiscard]] std::vector<EdgeOfTriangle> receiving_edges(const TriangleScene& scene);

} // namespace gnomon::scene
