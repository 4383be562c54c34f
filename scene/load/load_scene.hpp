#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

namespace gnomon::scene {

/// Builds or reads the scene that a job names, adds the ground and sets the roles.
/// @param normals  kept: of every corner, the file's, and where it has none, and of built-in
///                 scenes, those of `complete_vertex_normals`.
/// @throws InputError  as `load_scene_file`, `complete_parameters` and `set_roles` do.
[[nodiscard]] SceneFile load_scene(const SceneSettings& settings,
                                   VertexNormals normals = VertexNormals::dropped);

/// A scene that is loaded already, with the ground and the roles that a job asks for.
/// @param normals  kept: as above; those that the scene has stay.
/// @throws InputError  as `set_roles` does.
[[nodiscard]] SceneFile complete_scene(SceneFile loaded, const SceneSettings& settings,
                                       VertexNormals normals);

} // namespace gnomon::scene
