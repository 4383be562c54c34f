#pragma once

#include "analysis/presets/preset_result.hpp"
#include "scene/job/presets/presets.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// What `gnomon presets --json` prints: docs/json_schema.md.
[[nodiscard]] std::string presets_json(std::span<const scene::Preset> presets);

/// What `gnomon presets --compare JOB --json` prints.
[[nodiscard]] std::string preset_comparison_json(const analysis::PresetComparison& comparison);

} // namespace gnomon::reports
