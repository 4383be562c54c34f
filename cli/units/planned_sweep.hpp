#pragma once

#include "api/sweep/sweep_scenes.hpp"
#include "cli/options/job_options.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/settings/job.hpp"
#include "store/units/unit_plan.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The largest number that --units takes.
inline constexpr std::size_t most_units = 1'000'000;

/// Reads a sweep's scenes and divides the sweep into units.
/// @param axes    the values of --axis.
/// @param count   units at most; 0: about a minute for each.
/// @param scenes  the folder for packed scene files (`packed_scene_path`); empty: none are packed.
/// @throws scene::InputError        as `gnomon sweep`, for the job and its scenes.
/// @throws scene::EnvironmentError  if a scene cannot be written.
[[nodiscard]] store::UnitPlan plan_sweep(const JobOptions& options,
                                         const std::vector<std::string>& axes, std::size_t count,
                                         const std::filesystem::path& scenes = {});

/// The options that a plan was made with.
[[nodiscard]] JobOptions options_of(const store::PlannedJob& job);

/// All configurations of the planned sweep.
[[nodiscard]] scene::SweepSpace space_of(const store::PlannedJob& job);

/// A plan's entry for a scene.
/// @param name  for messages.
/// @param keys  the job's keys that name the scene.
[[nodiscard]] store::PlannedScene planned_scene(std::string name, std::string keys,
                                                const api::SceneContent& content);

/// The path of a packed scene in a folder, named by its content.
[[nodiscard]] std::filesystem::path packed_scene_path(const std::filesystem::path& folder,
                                                      const store::PlannedScene& scene);

/// Whether the folder has all of the unit's scenes that are files.
[[nodiscard]] bool has_packed_scenes(const std::filesystem::path& folder,
                                     const store::UnitPlan& plan, const store::PlannedUnit& unit);

/// Loads a planned scene from the folder or, if it is missing there, from the job's file.
/// @throws scene::InputError        as `scene::load_scene` does.
/// @throws scene::EnvironmentError  if a packed file is damaged.
[[nodiscard]] scene::SceneFile load_planned_scene(const std::filesystem::path& folder,
                                                  const store::UnitPlan& plan,
                                                  const scene::Job& job,
                                                  scene::VertexNormals normals);

} // namespace gnomon::cli
