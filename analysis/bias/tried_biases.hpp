#pragma once

#include "analysis/metrics/amounts.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// The biases that curves of fractions are tried at: 0, and 256 from 1e-7 to 1, 6.5 % apart.
[[nodiscard]] std::vector<float> tried_biases();

/// The 64 of them around the least amount of error, softening included, or all if there are fewer:
/// only for these are causes found, and what a kernel softens on purpose.
/// @param amounts  of each of the biases.
[[nodiscard]] std::span<const float> around_least(std::span<const float> biases,
                                                  std::span<const ErrorAmounts> amounts);

} // namespace gnomon::analysis
