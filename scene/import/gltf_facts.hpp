#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

struct aiScene;

namespace gnomon::scene {

/// A sound file of which something cannot be read; the text has its remedy.
class UnsupportedContent : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A punctual light where the file's own JSON puts it. Assimp joins lights and nodes by their
/// names, which in glTF may come again, and keeps one of the nodes that share a light.
struct GltfLight {
    std::size_t node = 0; ///< its place among the scene's nodes, parents before children
    std::string name;     ///< the node's; without one the light's
    std::string type;     ///< "directional", "point", "spot"
    float outer_cone_rad = 0;
};

/// What a glTF file's own JSON says and Assimp does not.
struct GltfFacts {
    std::uint64_t triangles = 0; ///< of the meshes that stand in its scene, each once
    std::vector<std::string> unread_extensions; ///< that it can do without, as it says
    bool requires_draco = false;
    std::size_t root_count = 0; ///< of the scene that is shown; glTF 2.0
    std::size_t node_count = 0; ///< all of that scene's
    std::vector<GltfLight> lights;
};

/// Reads the JSON of a .gltf or .glb file. The facts of any other file are the defaults; those of
/// glTF 1.0 have 0 triangles.
/// @throws UnsupportedContent  naming an extension that the file requires, or a skin that Assimp
///                             crashes on.
/// @throws std::runtime_error  naming a mesh whose indices make no whole number of triangles.
[[nodiscard]] GltfFacts read_gltf_facts(const std::filesystem::path& scene_file);

/// Checks that Assimp kept all triangles: it drops those with missing vertices in silence.
/// @throws std::runtime_error  with their number, if the scene lacks triangles.
/// @throws UnsupportedContent  if it lacks them for a compression that Assimp was built without.
void require_triangles(const GltfFacts& facts, const aiScene& scene);

} // namespace gnomon::scene
