#pragma once

#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::scene {

/// Whether an Assimp importer with this extension list (`aiImporterDesc`) reads a format that
/// Gnomon supports. The lists vary by version: "gltf glb" in 5.2, "gltf glb vrm" in 5.4.
[[nodiscard]] bool reads_known_format(std::string_view extensions);

/// Reads the file with Assimp and writes it, flattened to world space, as an import stream.
/// Includes vertex normals if they are kept.
///
/// Run this in a child process: damaged files make Assimp crash. Files that Assimp refuses or that
/// exceed `limits` once flattened become a refusal in the stream.
void write_imported_scene(const std::filesystem::path& scene_file, const ImportLimits& limits,
                          VertexNormals normals, ImportAllowance& allowance, int output);

} // namespace gnomon::scene
