#pragma once

#include <filesystem>

namespace gnomon::scene {

/// Whether a file's name says that it is a scene (.gltf, .glb, .obj, .ply), and no job file.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& path);

} // namespace gnomon::scene
