#pragma once

#include "reports/words/tuned_setting.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::reports {

/// How much a tune tells.
enum class TuneDetail : std::uint8_t {
    answer, ///< the recommended keys alone
    found,  ///< the best of each map, or method, what was measured and why
    tried,  ///< every setting
};

/// What was considered, the recommendation as TOML and as states of graphics interfaces, what was
/// measured with it in each view, and why; of several lights one after the other.
[[nodiscard]] std::string tune_text(std::span<const TunedLight> lights,
                                    const analysis::TuneLimits& limits, TuneDetail detail);

} // namespace gnomon::reports
