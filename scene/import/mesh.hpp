#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/stream.hpp"

#include <cstdint>
#include <vector>

struct aiMesh;

namespace gnomon::scene {

/// A mesh in its own coordinates; bit-equal positions are one vertex.
struct ImportedMesh {
    std::vector<Vec3f> vertices;
    std::vector<TriangleIndices> triangles;
    /// Of the file's corners, normals of any length; empty: it has none.
    std::vector<TriangleAttributes> attributes;
    std::uint64_t ignored_primitives = 0; ///< points and lines
};

/// Takes positions and triangulated faces, sharing vertices that importers keep apart for their
/// normals.
/// @param normals  kept: those of the corners, too.
/// @throws std::runtime_error  naming mesh and face, if a face uses a vertex that is not there.
[[nodiscard]] ImportedMesh imported_mesh(const aiMesh& mesh, VertexNormals normals);

} // namespace gnomon::scene
