#pragma once

#include "analysis/comparison/comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// What is wrong with this shadow map, the cheapest change that cures most of it and what that
/// leaves, and where the errors come from: a sentence each. Every number in them was measured, or
/// is exact by the bias curve; nothing is predicted. Empty without a diagnosis.
[[nodiscard]] std::vector<std::string> findings(const analysis::Comparison& comparison);

/// What is wrong, where it comes from, and what of the map would reduce it: a sentence each; empty
/// without a diagnosis.
[[nodiscard]] std::vector<std::string> errors_as_text(const analysis::Comparison& comparison);

} // namespace gnomon::reports
