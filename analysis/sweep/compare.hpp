#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <functional>
#include <span>

namespace gnomon::analysis {

/// Takes a comparison over. @param job  its index.
using TakeComparison = std::function<void(std::size_t job, Comparison&& comparison)>;

/// Resolves each job's view, runs both renderers over it and measures the difference: a sweep of
/// configurations that keep their pixels. Jobs share what they have in common, as the lights of a
/// job share receivers that no light moves.
///
/// `seconds.bvh` stays 0, and `seconds.scene` covers only what happens in here: whoever read the
/// scene and built the hierarchy adds that time.
/// @param file  The scene of all jobs; must outlive the comparisons, which point to its triangles.
/// @param take  gets each as soon as it is made, in the plan's order; what it throws ends the work.
/// @throws scene::InputError  as `scene::resolve_view` does, before anything is drawn.
/// @throws scene::EnvironmentError  if a renderer fails.
/// @throws std::invalid_argument  if a renderer returns layers that are not of the image's size.
void compare_each(std::span<const scene::Job> jobs, const scene::SceneFile& file,
                  const Renderers& renderers, const TakeComparison& take);

/// The same of one job.
[[nodiscard]] Comparison compare(const scene::Job& job, const scene::SceneFile& file,
                                 const Renderers& renderers);
Comparison compare(const scene::Job& job, const scene::SceneFile&& file,
                   const Renderers& renderers) = delete;

} // namespace gnomon::analysis
