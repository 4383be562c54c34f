#pragma once

#include "scene/import/folder.hpp"

#include <filesystem>

struct aiScene;

namespace gnomon::scene {

/// Refuses a PLY file that holds less than its header announces: Assimp repeats the last line of
/// one, or reads beyond the end. What Assimp alone can judge, such as a header that is none,
/// passes.
/// @throws UnsupportedContent  if it has triangle strips, of which Assimp reads one triangle alone.
/// @throws std::runtime_error  if it is cut off, or an ASCII file's elements share lines.
void require_whole_ply(const std::filesystem::path& ply_file);

/// A header for Assimp to read in place of a binary PLY file's own, or an empty one for the file as
/// it is. Assimp 5.2 takes a first data byte of 0x0A for part of a line end, and does not pass over
/// the data of elements that it does not know. So lines end with LF, data begin with a byte of our
/// own, and other elements become edges, which Assimp reads and leaves alone.
[[nodiscard]] FileHead head_for_assimp(const std::filesystem::path& ply_file);

/// @throws std::runtime_error  if fewer faces were read than the file's header announces.
void require_ply_faces(const std::filesystem::path& ply_file, const aiScene& scene);

} // namespace gnomon::scene
