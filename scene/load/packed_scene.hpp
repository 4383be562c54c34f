#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <span>

namespace gnomon::scene {

/// What the importer makes of the job's scene file and of the files that it names, in one piece: a
/// machine that has none of them loads the scene from it. For the same version of Gnomon alone.
/// @param settings  name a file.
/// @throws InputError  as `load_scene_file` does of a file that cannot be read.
[[nodiscard]] SealedBytes pack_scene(const SceneSettings& settings, VertexNormals normals);

/// The scene that `load_scene` would load where the file is.
/// @param packed   of `pack_scene` with the same file and normals; aligned to 8.
/// @throws InputError  if they are not that.
[[nodiscard]] SceneFile load_packed_scene(const SceneSettings& settings,
                                          std::span<const std::byte> packed, VertexNormals normals);

} // namespace gnomon::scene
