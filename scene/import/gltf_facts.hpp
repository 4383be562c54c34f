#pragma once

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

/// What a glTF file's own JSON says and Assimp does not.
struct GltfFacts {
    std::uint64_t triangles = 0; ///< of the meshes that stand in its scene, each once
    std::vector<std::string> unread_extensions; ///< that it can do without, as it says
    bool requires_draco = false;
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
