#pragma once

#include "scene/geometry/triangles.hpp"

#include <cstdint>
#include <string>

namespace gnomon::scene {

/// Whether a scene keeps normals of its vertices, 36 bytes for each triangle.
enum class VertexNormals : std::uint8_t { dropped, kept };

/// Faces at a corner whose normals are within this angle of a face's own are one curved surface
/// with it: between faces of what is round, and below the edges of what is square.
inline constexpr double crease_deg = 40;

/// Gives every corner that has none a unit normal: that of its vertex's faces, weighted by their
/// areas, of those within `crease_deg` of its own face.
///
///     n = Σ a_f n_f / |Σ a_f n_f|   over the faces f with n_f · n_own >= cos(crease)
///
/// Computed in double from the float32 vertices, and rounded once. Faces share a vertex by its
/// index, which those of different objects never do.
void complete_vertex_normals(TriangleScene& scene);

/// What corners' normals are in another space.
///
///     n' = sign(det M) cof(M) n / |cof(M) n|
///
/// the inverse transpose's direction, without an inverse: flattened meshes keep theirs.
/// @param to_other  M, to that space.
/// @param normal    of any length.
/// @return  Unit within 2^-22, rounded to float32 once; 0 where the normal is 0, not finite, or
/// lost.
[[nodiscard]] Vec3f moved_normal(const glm::dmat3& to_other, const Vec3d& normal);

/// A 64-bit FNV-1a hash of the normals, as 16 hexadecimal digits; empty where there are none.
[[nodiscard]] std::string normals_hash(const TriangleScene& scene);

/// The normal at a point of a triangle: the corners' own, weighted by its place among them.
/// @param point  in the triangle's plane [m].
/// @return  Unit, on the side of the triangle's winding; the geometric normal where the corners'
///          cancel out.
/// Precondition: the scene has normals.
[[nodiscard]] Vec3d vertex_normal_at(const TriangleScene& scene, std::uint32_t triangle,
                                     const Vec3d& point);

} // namespace gnomon::scene
