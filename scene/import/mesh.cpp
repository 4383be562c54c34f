#include "scene/import/mesh.hpp"

#include "scene/import/gltf_facts.hpp"
#include "scene/import/polygon.hpp"

#include <assimp/mesh.h>
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>

namespace gnomon::scene {

namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits position_bits(const Vec3f& position)
{
    return {std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
            std::bit_cast<std::uint32_t>(position.z)};
}

std::uint64_t hash(const PositionBits& bits)
{
    std::uint64_t value = 0;
    for (const std::uint32_t word : bits) {
        value = (value ^ word) * 0x9E3779B97F4A7C15ULL;
        value ^= value >> 32U;
    }
    return value;
}

/// Gives bit-equal positions the same index, in the order in which they first appear.
class VertexTable {
public:
    VertexTable(std::vector<Vec3f>& vertices, std::size_t capacity)
        : vertices_{vertices},
          slots_(std::bit_ceil(2 * capacity + 1), empty)
    {
    }
    std::uint32_t index_of(const Vec3f& position)
    {
        const PositionBits bits = position_bits(position);
        std::size_t slot = hash(bits) & (slots_.size() - 1);
        while (slots_[slot] != empty && position_bits(vertices_[slots_[slot]]) != bits) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        if (slots_[slot] == empty) {
            slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
            vertices_.push_back(position);
        }
        return slots_[slot];
    }

private:
    static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();
    std::vector<Vec3f>& vertices_;
    std::vector<std::uint32_t> slots_;
};

/// @throws std::runtime_error  naming mesh and face, if a face uses a vertex that is not there.
void check_indices(const aiMesh& mesh)
{
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            if (face.mIndices[k] >= mesh.mNumVertices) {
                throw std::runtime_error{
                    fmt::format("mesh \"{}\", face {}: vertex index {} of {} vertices",
                                mesh.mName.C_Str(), f, face.mIndices[k], mesh.mNumVertices)};
            }
        }
    }
}

/// Of a polygon: cutting it up takes time by the square of its corners.
constexpr unsigned most_corners = 100'000;

/// @throws UnsupportedContent  naming mesh and face, if a polygon is too large.
void check_corners(const aiMesh& mesh)
{
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const unsigned corners = mesh.mFaces[f].mNumIndices;
        if (corners > most_corners) {
            throw UnsupportedContent{fmt::format(
                "mesh \"{}\", face {}: a polygon of {} corners is too large, {} are the "
                "most; export it as triangles",
                mesh.mName.C_Str(), f, corners, most_corners)};
        }
    }
}

/// Attributes of the corners of a face's triangles, whose vertices are by now those of `polygon`.
class FaceAttributes {
public:
    FaceAttributes(const aiMesh& mesh, std::size_t vertex_count)
        : mesh_{mesh},
          source_of_(vertex_count)
    {
    }

    /// @param polygon    the vertices of the face's corners, in their order.
    /// @param triangles  what it was cut into.
    void append(const aiFace& face, std::span<const std::uint32_t> polygon,
                std::span<const TriangleIndices> triangles,
                std::vector<TriangleAttributes>& attributes)
    {
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            source_of_[polygon[k]] = face.mIndices[k];
        }
        for (const TriangleIndices& triangle : triangles) {
            TriangleAttributes& corners = attributes.emplace_back();
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const aiVector3D& n = mesh_.mNormals[source_of_[triangle.at(k)]];
                corners.at(k).normal = {n.x, n.y, n.z};
            }
        }
    }

private:
    const aiMesh& mesh_;
    std::vector<std::uint32_t> source_of_; ///< [vertex] the mesh's, at the face's corner
};

} // namespace

ImportedMesh imported_mesh(const aiMesh& mesh, VertexNormals normals)
{
    check_indices(mesh);
    check_corners(mesh);
    ImportedMesh result;
    VertexTable table{result.vertices, mesh.mNumVertices};
    std::vector<std::uint32_t> index_of(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiVector3D& p = mesh.mVertices[v];
        index_of[v] = table.index_of({p.x, p.y, p.z});
    }
    result.triangles.reserve(mesh.mNumFaces);
    const bool keeps_normals = normals == VertexNormals::kept && mesh.HasNormals();
    FaceAttributes face_attributes{mesh, keeps_normals ? result.vertices.size() : 0};
    std::vector<std::uint32_t> polygon;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices < 3) {
            ++result.ignored_primitives;
            continue;
        }
        polygon.clear();
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            polygon.push_back(index_of[face.mIndices[k]]);
        }
        const std::size_t first = result.triangles.size();
        triangulate(result.vertices, polygon, result.triangles);
        if (keeps_normals) {
            face_attributes.append(face, polygon, std::span{result.triangles}.subspan(first),
                                   result.attributes);
        }
    }
    return result;
}

} // namespace gnomon::scene
