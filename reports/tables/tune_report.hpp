#pragma once

#include "reports/text/tuned_setting.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::reports {

/// How much a tune tells.
enum class TuneDetail : std::uint8_t {
    answer, ///< the recommended keys alone
    found,  ///< ten lines: what to set in place of the job's own, and what it gives
    tried,  ///< every setting, states of graphics interfaces, each view, and what is left
};

/// The recommendation as TOML, with as much as is asked for; of several lights one after the other.
/// A search over methods has a table of them, and all its details, in `found`, too.
[[nodiscard]] std::string tune_text(std::span<const TunedLight> lights, TuneDetail detail);

} // namespace gnomon::reports
