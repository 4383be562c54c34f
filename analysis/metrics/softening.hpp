#pragma once

#include "analysis/limits/bias_rows.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// What a kernel softens on purpose: the amounts of the errors that are `edge` by `filter` [px].
struct Softening {
    double shadow = 0; ///< of lit pixels
    double light = 0;  ///< of blocked pixels

    [[nodiscard]] double total() const { return shadow + light; }
    Softening& operator+=(const Softening& other)
    {
        shadow += other.shadow;
        light += other.light;
        return *this;
    }
};

/// What of the softening at a bias is left out of errors: of each side at most what is softened
/// with a constant bias of 0, for what a bias adds is not softening.
[[nodiscard]] inline Softening left_out(const Softening& at_bias, const Softening& at_zero)
{
    return {std::min(at_bias.shadow, at_zero.shadow), std::min(at_bias.light, at_zero.light)};
}

/// The softening at each of several biases, as `count_rows` has it among all causes; but only
/// pixels that can be soft are looked at.
/// @param inputs  With the causes of all pixels that are wrong or partial at any of the biases.
/// @param biases  Ascending, 0 or normal.
[[nodiscard]] std::vector<Softening> softening_at(const BiasRowInputs& inputs,
                                                  std::span<const float> biases);

} // namespace gnomon::analysis
