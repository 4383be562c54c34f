#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <optional>

namespace gnomon::scene {

/// A job and its scene as they would be with the origin elsewhere.
struct MovedScene {
    Vec3d origin; ///< where the new origin lies in the old coordinates [m]
    SceneFile file;
    Job job; ///< with camera and light written out
};

/// Moves the origin to the scene's centre, along the axes where the scene lies far from it: such
/// that no coordinate loses a digit, and everything seen and true stays what it is.
/// @return  Empty if the origin is near already, or coordinates would round.
[[nodiscard]] std::optional<MovedScene> move_origin_near(const Job& job, const SceneFile& file);

} // namespace gnomon::scene
