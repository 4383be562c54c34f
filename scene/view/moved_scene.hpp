#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <optional>

namespace gnomon::scene {

/// A job and its scene, relative to a new origin.
struct MovedScene {
    Vec3d origin; ///< where the new origin lies in the old coordinates [m]
    SceneFile file;
    Job job; ///< with camera and light written out
};

/// Moves the origin to the scene's centre along axes where the scene lies far from it. All
/// coordinates move exactly, so the view and the truth do not change.
/// @return  Empty if the origin is near already, or coordinates would round.
[[nodiscard]] std::optional<MovedScene> move_origin_near(const Job& job, const SceneFile& file);

} // namespace gnomon::scene
