#pragma once

#include "analysis/metrics/peter_panning_gaps.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// A pixel whose shadow the bias detaches, once it is at least `critical_bias`.
struct PanningGap {
    float critical_bias = 0;
    PixelGap gap; ///< however far the bias reaches
    std::size_t pixel = 0;
};

/// How far the biases of a pixel reach, with a constant bias [m]; it does not fall when that rises.
using BiasReach = std::function<double(std::size_t pixel, float bias)>;

/// The peter-panning lengths at each bias: no gap is longer than the biases reach.
/// @param biases  Ascending.
/// @param reach   Empty: any gap is reached.
[[nodiscard]] std::vector<Gaps> find_gaps_at(std::vector<PanningGap> gaps,
                                             std::span<const float> biases, const BiasReach& reach);

} // namespace gnomon::analysis
