#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <functional>
#include <span>

namespace gnomon::analysis {

/// Receives a comparison. @param job  its index.
using TakeComparison = std::function<void(std::size_t job, Comparison&& comparison)>;

/// Resolves each job's view, runs both renderers and measures the difference: a sweep of
/// configurations that keep their pixels. Jobs share stages, such as the receivers that no light of
/// a job moves.
///
/// `seconds.bvh` stays 0, and `seconds.scene` covers only work in here: the caller adds the time to
/// read the scene and build the hierarchy.
/// @param file  The scene of all jobs; must outlive the comparisons, which point to its triangles.
/// @param take  Gets each comparison once it is ready, in the plan's order; its exceptions end the
///              work.
/// @throws scene::InputError  As `scene::resolve_view` does, before any drawing.
/// @throws scene::EnvironmentError  if a renderer fails.
/// @throws std::invalid_argument  if a renderer returns layers of another size than the image's.
void compare_each(std::span<const scene::Job> jobs, const scene::SceneFile& file,
                  const Renderers& renderers, const TakeComparison& take);

/// Compares one job.
[[nodiscard]] Comparison compare(const scene::Job& job, const scene::SceneFile& file,
                                 const Renderers& renderers);
Comparison compare(const scene::Job& job, const scene::SceneFile&& file,
                   const Renderers& renderers) = delete;

} // namespace gnomon::analysis
