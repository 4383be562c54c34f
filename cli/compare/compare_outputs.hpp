#pragma once

#include "analysis/comparison/comparison.hpp"
#include "cli/compare/compare_options.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/file.hpp"

#include <span>

namespace gnomon::cli {

/// Fails before the work, not after it.
/// @param jobs  of all lights; of several each has files of its own, but for --aov.
/// @throws scene::InputError, scene::EnvironmentError  as `require_outputs` and `require_absent`.
void require_new_outputs(const CompareOptions& options, std::span<const scene::LightJob> jobs);

/// Writes what is asked of GL beyond the comparison: its maps, and a case for `gnomon evaluate`.
/// @param renderers  of the comparison.
/// @throws scene::EnvironmentError  if it cannot be written.
void write_from_gl(const CompareOptions& options, const analysis::Comparison& comparison,
                   const scene::SceneDefaults& defaults, const analysis::Renderers& renderers);

/// Writes the files that the options name, and prints the result.
/// @param lights  the comparison of each light, at least one.
/// @throws scene::EnvironmentError  if a file cannot be written.
void write_outputs(const CompareOptions& options, std::span<const analysis::Comparison> lights);

} // namespace gnomon::cli
