#pragma once

#include "analysis/presets/engine_settings.hpp"
#include "store/json.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// Lines to paste into the engine's code, what they mean, and what the engine cannot be told.
[[nodiscard]] std::string engine_settings_text(const std::vector<analysis::EngineSettings>& lights);

/// One light's settings as a JSON object (docs/json_schema.md#engine-settings).
[[nodiscard]] store::Json engine_settings_object(const analysis::EngineSettings& light);

/// The objects of all lights, as `gnomon settings --json` prints them.
[[nodiscard]] std::string engine_settings_json(const std::vector<analysis::EngineSettings>& lights);

} // namespace gnomon::reports
