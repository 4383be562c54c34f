#pragma once

#include "reports/tune/tuned_setting.hpp"

#include <cstdint>
#include <span>
#include <string>

/// The outputs of `gnomon tune`.
namespace gnomon::reports {

/// How much `tune_text` prints.
enum class TuneDetail : std::uint8_t {
    answer, ///< only the recommended keys
    found,  ///< ten lines: the keys to change, and the resulting errors
    tried,  ///< every setting, graphics API states, each view, and the remaining errors
};

/// The recommendation as TOML, with the requested detail; several lights one after the other. A
/// search over methods prints its ranking and all details for `found`, too.
[[nodiscard]] std::string tune_text(std::span<const TunedLight> lights, TuneDetail detail);

/// The search results as one JSON object; docs/tune.md names its members.
[[nodiscard]] std::string tune_json(std::span<const TunedLight> lights);

} // namespace gnomon::reports
