#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace gnomon::scene {

/// The import stream of a scene file: what its importer says of it, a refusal too.
/// @throws InputError  if the file cannot be opened, or the importer crashed or exceeded a limit.
[[nodiscard]] SealedBytes pack_scene_file(const std::filesystem::path& path,
                                          const ImportLimits& limits, VertexNormals normals);

/// What `load_scene_file` returns of the file with this stream.
/// @param path    of that file, which need not be there: for messages and names.
/// @param packed  aligned to 8.
/// @param space   `load_scene_file`'s.
/// @throws InputError  as `load_scene_file` does.
[[nodiscard]] SceneFile unpack_scene_file(const std::filesystem::path& path,
                                          std::span<const std::byte> packed,
                                          const ImportLimits& limits, const FileSpace& space = {});

} // namespace gnomon::scene
