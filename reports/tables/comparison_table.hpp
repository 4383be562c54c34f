#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>

namespace gnomon::reports {

/// A comparison as the short aligned table that `gnomon compare` prints: scene, settings, classes,
/// errors, rates with their denominators, seconds. Plain text, at most about 80 columns wide.
[[nodiscard]] std::string comparison_table(const analysis::Comparison& comparison);

} // namespace gnomon::reports
