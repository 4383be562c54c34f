#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/stream.hpp"

#include <cstdint>
#include <span>
#include <vector>

struct aiMesh;

namespace gnomon::scene {

/// Appends the n − 2 triangles of a polygon, wound as the polygon is.
///
/// Clips ears in the coordinate plane in which the polygon is largest, and never cuts through
/// another vertex. A convex polygon becomes a fan from its first corner; any simple polygon is
/// covered once. The result for a self-intersecting polygon is arbitrary. 100,000 corners take 2 s.
/// @param vertices  positions [m].
/// @param polygon   n >= 3 indices into `vertices`.
void triangulate(std::span<const Vec3f> vertices, std::span<const std::uint32_t> polygon,
                 std::vector<TriangleIndices>& triangles);

/// A mesh in its own coordinates; bit-equal positions are one vertex.
struct ImportedMesh {
    std::vector<Vec3f> vertices;
    std::vector<TriangleIndices> triangles;
    /// The file's normals at corners, of any length; empty if it has none.
    std::vector<TriangleAttributes> attributes;
    std::uint64_t ignored_primitives = 0; ///< points and lines
};

/// Triangulates the faces and merges vertices that importers duplicate for different normals.
/// @param normals  kept: also reads the corners' normals.
/// @throws std::runtime_error  naming mesh and face, if a face uses a vertex that does not exist.
[[nodiscard]] ImportedMesh imported_mesh(const aiMesh& mesh, VertexNormals normals);

} // namespace gnomon::scene
