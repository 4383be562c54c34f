#pragma once

#include "scene/infinity.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A comparison's critical bias, and how much it counts.
using WeighedCritical = std::pair<float, double>;

/// The smallest of the critical biases with which comparisons of enough weight are lit; +∞ if not
/// even all are enough.
/// @param taps       in any order; reordered.
/// @param is_enough  `is_enough(lit, all)`: whether so much of the weight is; rises with `lit`.
template <typename IsEnough>
[[nodiscard]] float smallest_lit_bias(std::vector<WeighedCritical>& taps, const IsEnough& is_enough)
{
    double all = 0;
    for (const auto& [critical, weight] : taps) {
        all += weight;
    }
    std::ranges::sort(taps);
    double lit = 0;
    for (const auto& [critical, weight] : taps) {
        lit += weight;
        if (is_enough(lit, all)) {
            return critical;
        }
    }
    return scene::infinity;
}

} // namespace gnomon::analysis
