#pragma once

#include "scene/import_process.hpp"
#include "scene/scene_file.hpp"

#include <filesystem>

namespace gnomon::scene {

/// Reads the file with Assimp and writes it, flattened to world space, as an import stream.
///
/// To be run in a child process: damaged files make Assimp crash. What it refuses, and files that
/// exceed `limits` once flattened, become a refusal in the stream.
void write_imported_scene(const std::filesystem::path& scene_file, const ImportLimits& limits,
                          ImportAllowance& allowance, int output);

} // namespace gnomon::scene
