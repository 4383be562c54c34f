#pragma once

#include "analysis/comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::reports {

/// What is wrong with this shadow map and what to change, in two or three plain sentences. Every
/// number in them was measured, or is exact by the bias curve; nothing is predicted.
[[nodiscard]] std::vector<std::string> findings(const analysis::Comparison& comparison);

/// The part of it that says what is wrong, and what of the map would reduce it.
[[nodiscard]] std::vector<std::string> errors_in_words(const analysis::Comparison& comparison);

} // namespace gnomon::reports
