#pragma once

#include "analysis/limits/bias_rows.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Intended softening by a kernel: error amounts of the label `edge` and the cause `filter` [px].
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

/// The part of the softening at a bias that is no error: on each side at most the softening at a
/// constant bias of 0, since further softening comes from the bias.
[[nodiscard]] inline Softening left_out(const Softening& at_bias, const Softening& at_zero)
{
    return {std::min(at_bias.shadow, at_zero.shadow), std::min(at_bias.light, at_zero.light)};
}

/// The softening at each of several biases, equal to that in `count_rows`. Visits only pixels that
/// can be soft.
/// @param inputs  With the causes of all pixels that are wrong or partial at any of the biases.
/// @param biases  Ascending, 0 or normal.
[[nodiscard]] std::vector<Softening> softening_at(const BiasRowInputs& inputs,
                                                  std::span<const float> biases);

} // namespace gnomon::analysis
