#pragma once

#include <filesystem>

struct aiScene;

namespace gnomon::scene {

/// Refuses a PLY file that holds less than its header announces: Assimp repeats the last line of
/// one, or reads beyond the end. What Assimp alone can judge, such as a header that is none,
/// passes.
/// @throws UnsupportedContent  if it has triangle strips, of which Assimp reads one triangle alone.
/// @throws std::runtime_error  if it is cut off, or an ASCII file's elements share lines.
void require_whole_ply(const std::filesystem::path& ply_file);

/// @throws std::runtime_error  if fewer faces were read than the file's header announces.
void require_ply_faces(const std::filesystem::path& ply_file, const aiScene& scene);

} // namespace gnomon::scene
