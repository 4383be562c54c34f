#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/job/job.hpp"

namespace gnomon::scene {

/// Builds or reads the scene that a job names, adds the ground and sets the roles.
/// @throws InputError  as `load_scene_file`, `complete_parameters` and `set_roles` do.
[[nodiscard]] SceneFile load_scene(const SceneSettings& settings);

} // namespace gnomon::scene
