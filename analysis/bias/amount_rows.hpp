#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/tap_criticals.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The amounts of error at each bias: sums of a pcfK lookup's taps, as integers.
/// @param biases  Ascending.
/// @return  In the order of the biases.
/// @throws std::invalid_argument  if they do not ascend.
[[nodiscard]] std::vector<ErrorAmounts> sum_amounts(const scene::Image<scene::PixelClass>& classes,
                                                    const TapCriticals& taps,
                                                    std::span<const float> biases);
/// The same of a lookup with one comparison, whose amounts are its counts.
[[nodiscard]] std::vector<ErrorAmounts> sum_amounts(const BiasCurve& curve,
                                                    std::span<const float> biases);

/// How many taps of each scored pixel are lit, in an image for each bias, in their order; 0 where a
/// pixel is not scored.
[[nodiscard]] std::vector<scene::Image<std::uint8_t>>
count_lit_taps(const scene::Image<scene::PixelClass>& classes, const TapCriticals& taps,
               std::span<const float> biases);

} // namespace gnomon::analysis
