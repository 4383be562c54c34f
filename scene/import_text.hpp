#pragma once

#include <cstdint>
#include <filesystem>

struct aiScene;

namespace gnomon::scene {

/// How many curves and surfaces an OBJ file holds beside its polygons: Assimp passes them over.
[[nodiscard]] std::uint64_t count_free_form_shapes(const std::filesystem::path& obj_file);

/// @throws UnsupportedContent  if a PLY file has triangle strips, of which Assimp reads one
///                             triangle alone.
/// @throws std::runtime_error  if fewer faces were read than the file's header announces.
void require_faces(const std::filesystem::path& ply_file, const aiScene& scene);

} // namespace gnomon::scene
