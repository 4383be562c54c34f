#pragma once

#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"
#include "store/units/unit_plan.hpp"

#include <filesystem>

namespace gnomon::cli {

/// Where a folder has a plan's scene, packed, by its content.
[[nodiscard]] std::filesystem::path packed_scene_path(const std::filesystem::path& folder,
                                                      const store::PlannedScene& scene);

/// Whether the folder has all scenes of the unit that are files.
[[nodiscard]] bool has_packed_scenes(const std::filesystem::path& folder,
                                     const store::UnitPlan& plan, const store::PlannedUnit& unit);

/// Loads a scene of a plan from the folder, or where that lacks it from where the job says.
/// @throws scene::InputError        as `scene::load_scene` does.
/// @throws scene::EnvironmentError  if a packed file is damaged.
[[nodiscard]] scene::SceneFile load_planned_scene(const std::filesystem::path& folder,
                                                  const store::UnitPlan& plan,
                                                  const scene::Job& job,
                                                  scene::VertexNormals normals);

} // namespace gnomon::cli
