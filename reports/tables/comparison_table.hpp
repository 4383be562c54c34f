#pragma once

#include "analysis/comparison/comparison.hpp"

#include <span>
#include <string>

namespace gnomon::reports {

/// The short aligned table that `gnomon compare` prints: scene, settings, classes, errors, rates
/// with their denominators, seconds. At most about 80 columns wide.
[[nodiscard]] std::string comparison_table(const analysis::Comparison& comparison);

/// The table for a job with several lights: each light's `comparison_table` under its name, then
/// one line per light and one for all lights together.
/// @param lights  at least one.
[[nodiscard]] std::string lights_table(std::span<const analysis::Comparison> lights);

/// The text that `gnomon evaluate --check` prints, with a final newline.
[[nodiscard]] std::string check_text(const analysis::ImportCheck& check);

} // namespace gnomon::reports
