#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/taps.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The amounts of error at each bias: sums over the taps of a pcfK lookup, as integers.
/// @param biases  Ascending.
/// @return  In the order of the biases.
/// @throws std::invalid_argument  if the biases do not ascend.
[[nodiscard]] std::vector<ErrorAmounts> sum_amounts(const scene::Image<scene::PixelClass>& classes,
                                                    const TapCriticals& taps,
                                                    std::span<const float> biases);
/// The amounts of a lookup with one comparison, which equal its counts.
[[nodiscard]] std::vector<ErrorAmounts> sum_amounts(const BiasCurve& curve,
                                                    std::span<const float> biases);

/// The number of lit taps of each scored pixel (else 0): one image for each bias, in their order.
[[nodiscard]] std::vector<scene::Image<std::uint8_t>>
count_lit_taps(const scene::Image<scene::PixelClass>& classes, const TapCriticals& taps,
               std::span<const float> biases);

} // namespace gnomon::analysis
