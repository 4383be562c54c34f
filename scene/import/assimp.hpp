#pragma once

#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"

#include <filesystem>
#include <string_view>

namespace gnomon::scene {

/// Whether an importer of Assimp's with this list of extensions, as aiImporterDesc has it, reads a
/// format that Gnomon reads. Versions list more beside ours: "gltf glb" in 5.2, "gltf glb vrm"
/// in 5.4.
[[nodiscard]] bool reads_known_format(std::string_view extensions);

/// Reads the file with Assimp and writes it, flattened to world space, as an import stream; with
/// its vertices' normals where they are kept.
///
/// To be run in a child process: damaged files make Assimp crash. What it refuses, and files that
/// exceed `limits` once flattened, become a refusal in the stream.
void write_imported_scene(const std::filesystem::path& scene_file, const ImportLimits& limits,
                          VertexNormals normals, ImportAllowance& allowance, int output);

} // namespace gnomon::scene
