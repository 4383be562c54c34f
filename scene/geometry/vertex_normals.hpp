#pragma once

#include "scene/geometry/triangles.hpp"

#include <cstdint>
#include <string>

namespace gnomon::scene {

/// Whether a scene keeps normals of its vertices, 36 bytes for each triangle.
enum class VertexNormals : std::uint8_t { dropped, kept };

/// Faces at a corner whose normals differ by at most this angle form one curved surface. Larger
/// than the angle between faces of round shapes, smaller than that at the edges of boxes.
inline constexpr double crease_deg = 40;

/// Gives every corner without a normal a unit normal: the area-weighted mean over the vertex's
/// faces within `crease_deg` of the corner's own face.
///
///     n = Σ a_f n_f / |Σ a_f n_f|   over the faces f with n_f · n_own >= cos(crease)
///
/// Computed in double from the float32 vertices and rounded once. Faces share a vertex by its
/// index, so faces of different objects never do.
void complete_vertex_normals(TriangleScene& scene);

/// Transforms a normal to another space.
///
///     n' = sign(det M) cof(M) n / |cof(M) n|
///
/// the direction of the inverse transpose, but without an inverse, so that flattened meshes keep
/// their normals.
/// @param to_other  M, the linear map to that space.
/// @param normal    of any length.
/// @return  Unit within 2^-22, rounded to float32 once; 0 if the normal is 0 or not finite, or its
///          image vanishes.
[[nodiscard]] Vec3f moved_normal(const glm::dmat3& to_other, const Vec3d& normal);

/// A 64-bit FNV-1a hash of the normals, as 16 hexadecimal digits; empty without normals.
[[nodiscard]] std::string normals_hash(const TriangleScene& scene);

/// The normal at a point of a triangle, interpolated from its corners.
/// @param point  in the triangle's plane [m].
/// @return  Unit, on the side of the triangle's winding; the geometric normal where the corners'
///          cancel out.
/// Precondition: the scene has normals.
[[nodiscard]] Vec3d vertex_normal_at(const TriangleScene& scene, std::uint32_t triangle,
                                     const Vec3d& point);

} // namespace gnomon::scene
