#pragma once

#include "analysis/bias/bias_rows.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// What a kernel softens on purpose: the amounts of the errors that are `edge` by `filter` [px].
struct Softening {
    double shadow = 0; ///< of lit pixels
    double light = 0;  ///< of blocked pixels

    [[nodiscard]] double total() const { return shadow + light; }
};

/// The softening at each of several biases, as `count_rows` has it among all causes; but only
/// pixels that can be soft are looked at.
/// @param inputs  With the causes of all pixels that are wrong or partial at any of the biases.
/// @param biases  Ascending, 0 or normal.
[[nodiscard]] std::vector<Softening> softening_at(const BiasRowInputs& inputs,
                                                  std::span<const float> biases);

} // namespace gnomon::analysis
