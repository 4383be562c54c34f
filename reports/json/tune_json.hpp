#pragma once

#include "reports/text/tuned_setting.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// What a search has found, as one JSON object; docs/tune.md names its members.
[[nodiscard]] std::string tune_json(std::span<const TunedLight> lights);

} // namespace gnomon::reports
