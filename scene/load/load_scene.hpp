#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <span>

namespace gnomon::scene {

/// Builds or reads the scene that a job names, adds the ground and sets the roles.
/// @param normals  kept: of every corner, from the file or else from `complete_vertex_normals`.
/// @throws InputError  as `load_scene_file`, `complete_parameters` and `set_roles`.
[[nodiscard]] SceneFile load_scene(const SceneSettings& settings,
                                   VertexNormals normals = VertexNormals::dropped);

/// Adds the ground and the roles that a job asks for to a loaded scene.
/// @param normals  kept: as above; existing normals stay.
/// @throws InputError  as `set_roles`.
[[nodiscard]] SceneFile complete_scene(SceneFile loaded, const SceneSettings& settings,
                                       VertexNormals normals);

/// Packs the imported scene file and the files that it names, so that another machine can load the
/// scene without them. Only the same version of Gnomon can read it.
/// @param settings  must name a file.
/// @throws InputError  as `load_scene_file` for a file that cannot be read.
[[nodiscard]] SealedBytes pack_scene(const SceneSettings& settings, VertexNormals normals);

/// Loads a packed scene: the result of `load_scene` with the file.
/// @param packed   from `pack_scene` with the same file and normals; aligned to 8.
/// @throws InputError  if the bytes are not a packed scene.
[[nodiscard]] SceneFile load_packed_scene(const SceneSettings& settings,
                                          std::span<const std::byte> packed, VertexNormals normals);

} // namespace gnomon::scene
