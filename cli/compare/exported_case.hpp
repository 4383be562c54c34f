#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"

#include <filesystem>

namespace gnomon::cli {

/// Writes GL's verdict as another renderer's case (docs/evaluate.md).
/// @param defaults   that the comparison's scene brings along.
/// @param renderers  of the comparison: its map is drawn, and looked up, again.
/// @throws scene::EnvironmentError  if it cannot be written.
void export_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                 const scene::SceneDefaults& defaults, const analysis::Renderers& renderers);

} // namespace gnomon::cli
