#pragma once

#include "api/sweep/sweep_scenes.hpp"
#include "cli/options/job_options.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/units/unit_plan.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The largest number that --units takes.
inline constexpr std::size_t most_units = 1'000'000;

/// Plans a sweep in units. Its scenes are read.
/// @param axes    of --axis.
/// @param count   of units at most; 0: such that each takes about a minute.
/// @param scenes  a folder, in which those that are files are packed (`packed_scene_path`); empty:
///                they are not.
/// @throws scene::InputError        as `gnomon sweep` does of a job and its scenes.
/// @throws scene::EnvironmentError  if a scene cannot be written there.
[[nodiscard]] store::UnitPlan plan_sweep(const JobOptions& options,
                                         const std::vector<std::string>& axes, std::size_t count,
                                         const std::filesystem::path& scenes = {});

/// The options that a plan was made of.
[[nodiscard]] JobOptions options_of(const store::PlannedJob& job);

/// All configurations of the planned sweep.
[[nodiscard]] scene::SweepSpace space_of(const store::PlannedJob& job);

/// What a scene is in a plan.
/// @param name  for messages.
/// @param keys  of the job that name it.
[[nodiscard]] store::PlannedScene planned_scene(std::string name, std::string keys,
                                                const api::SceneContent& content);

} // namespace gnomon::cli
