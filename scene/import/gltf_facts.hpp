#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

struct aiScene;

namespace gnomon::scene {

/// The file is valid but uses something unsupported; the text includes a remedy.
class UnsupportedContent : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A punctual light, placed as the file's JSON says. Assimp joins lights and nodes by name,
/// although glTF names may repeat, and keeps only one of the nodes that share a light.
struct GltfLight {
    std::size_t node = 0; ///< its index among the scene's nodes, parents before children
    std::string name;     ///< the node's name, or else the light's
    std::string type;     ///< "directional", "point", "spot"
    float outer_cone_rad = 0;
};

/// Facts from a glTF file's JSON that Assimp does not report.
struct GltfFacts {
    std::uint64_t triangles = 0;                ///< of the meshes in its scene, each counted once
    std::vector<std::string> unread_extensions; ///< optional extensions that are not supported
    bool requires_draco = false;
    std::size_t root_count = 0; ///< of the scene that is shown; glTF 2.0
    std::size_t node_count = 0; ///< all of that scene's
    std::vector<GltfLight> lights;
};

/// Reads the JSON of a .gltf or .glb file. Returns defaults for other files, and 0 triangles for
/// glTF 1.0.
/// @throws UnsupportedContent  naming an extension that the file requires, or a skin that Assimp
///                             crashes on.
/// @throws std::runtime_error  naming a mesh whose index count is not a multiple of triangles.
[[nodiscard]] GltfFacts read_gltf_facts(const std::filesystem::path& scene_file);

/// Checks that Assimp kept all triangles: it silently drops those with missing vertices.
/// @throws std::runtime_error  with their number, if the scene lacks triangles.
/// @throws UnsupportedContent  if Assimp was built without the compression that they need.
void require_triangles(const GltfFacts& facts, const aiScene& scene);

} // namespace gnomon::scene
