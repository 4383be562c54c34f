#pragma once

#include "analysis/tune.hpp"

#include <string>

namespace gnomon::reports {

/// The keys of a setting, ready to paste into a job file. Numbers read back to the same bits.
[[nodiscard]] std::string tune_toml(const analysis::TunedSetting& setting);

/// What was considered, the recommendation as TOML, what was measured with it, and why.
[[nodiscard]] std::string tune_text(const analysis::TuneResult& result,
                                    const analysis::TuneLimits& limits);

/// The same as one JSON object; docs/tune.md names its members.
[[nodiscard]] std::string tune_json(const analysis::TuneResult& result,
                                    const analysis::TuneLimits& limits);

} // namespace gnomon::reports
