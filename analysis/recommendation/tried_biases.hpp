#pragma once

#include <vector>

namespace gnomon::analysis {

/// The biases that a curve is tried at first where each costs a lookup: 0, and four a decade from
/// 1e-6 to 1. Ascending.
[[nodiscard]] std::vector<float> coarse_biases();

/// The biases that curves of fractions are tried at: 0, 256 from 1e-7 to 1, 6.5 % apart, and the
/// coarse ones. Ascending.
[[nodiscard]] std::vector<float> fine_biases();

} // namespace gnomon::analysis
