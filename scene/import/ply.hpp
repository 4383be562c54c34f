#pragma once

#include "scene/import/folder.hpp"

#include <filesystem>

struct aiScene;

namespace gnomon::scene {

/// Refuses a PLY file that is shorter than its header announces: Assimp would repeat the last line
/// or read beyond the end. Leaves other errors, such as an invalid header, to Assimp.
/// @throws UnsupportedContent  if it has triangle strips, of which Assimp reads only one triangle.
/// @throws std::runtime_error  if it is cut off, or an ASCII file's elements share lines.
void require_whole_ply(const std::filesystem::path& ply_file);

/// A replacement header for a binary PLY file; empty if none is needed. Assimp 5.2 takes a first
/// data byte of 0x0A for part of a line end and does not skip the data of unknown elements. So
/// lines end with LF, an extra byte precedes the data, and unknown elements become edges, which
/// Assimp reads and ignores.
[[nodiscard]] FileHead head_for_assimp(const std::filesystem::path& ply_file);

/// @throws std::runtime_error  if Assimp read fewer faces than the header announces.
void require_ply_faces(const std::filesystem::path& ply_file, const aiScene& scene);

} // namespace gnomon::scene
