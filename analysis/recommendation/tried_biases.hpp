#pragma once

#include "analysis/metrics/amounts.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// The biases that curves of fractions are tried at: 0, and 256 from 1e-7 to 1, 6.5 % apart.
[[nodiscard]] std::vector<float> tried_biases();

/// The biases that a curve is tried at first where each costs a lookup: 0, and four a decade from
/// 1e-6 to 1.
[[nodiscard]] std::vector<float> coarse_biases();

/// At most 64 biases around the least amount of error: `tried_biases` and coarse ones within three
/// steps of it.
/// @param coarse   `coarse_biases`.
/// @param amounts  of each of them.
/// @return  Ascending.
[[nodiscard]] std::vector<float> fine_biases_around_least(std::span<const float> coarse,
                                                          std::span<const ErrorAmounts> amounts);

/// The coarse biases within three steps of the least amount of error.
/// @param coarse   `coarse_biases`.
/// @param amounts  of each of them.
[[nodiscard]] std::vector<float> coarse_biases_around_least(std::span<const float> coarse,
                                                            std::span<const ErrorAmounts> amounts);

/// The 64 of `tried_biases` around the least amount of error, softening included, or all if there
/// are fewer: only for these are causes found, and what a kernel softens on purpose.
/// @param amounts  of each of the biases.
[[nodiscard]] std::span<const float> around_least(std::span<const float> biases,
                                                  std::span<const ErrorAmounts> amounts);

} // namespace gnomon::analysis
