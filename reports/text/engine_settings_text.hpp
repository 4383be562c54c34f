#pragma once

#include "analysis/presets/engine_settings.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// Lines to paste into the engine's code, what they mean, and what the engine cannot be told.
[[nodiscard]] std::string engine_settings_text(const std::vector<analysis::EngineSettings>& lights);

/// The same as JSON (docs/json_schema.md).
[[nodiscard]] std::string engine_settings_json(const std::vector<analysis::EngineSettings>& lights);

} // namespace gnomon::reports
