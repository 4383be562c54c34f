#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/results/results.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What a comparison measured.
[[nodiscard]] ConfigurationResult result_of(const Comparison& comparison);
/// What each of several comparisons measured.
[[nodiscard]] std::vector<ConfigurationResult> results_of(std::span<const Comparison> comparisons);

/// A configuration's row from its own comparison; the curve from its diagnosis, empty if it is
/// another renderer's and has none.
/// @throws std::invalid_argument  if a comparison of GL's own has no diagnosis.
[[nodiscard]] FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                                            std::uint64_t ordinal);

} // namespace gnomon::analysis
