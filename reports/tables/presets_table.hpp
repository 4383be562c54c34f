#pragma once

#include "analysis/presets/preset_result.hpp"
#include "scene/job/presets/presets.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// What `gnomon presets` prints.
[[nodiscard]] std::string presets_table(std::span<const scene::Preset> presets);

/// What `gnomon presets --compare JOB` prints.
[[nodiscard]] std::string preset_comparison_table(const analysis::PresetComparison& comparison);

} // namespace gnomon::reports
