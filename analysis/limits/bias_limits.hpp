#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/limits/acne_free.hpp"

#include <array>
#include <functional>
#include <span>

namespace gnomon::analysis {

/// The two limits of a constant bias, which may be infinite. A bias is free of acne iff it is at
/// least `acne_free`, and free of panning iff it is at most `panning_free`.
///
/// `acne_free`, of either kind, is −∞ if every bias is free of acne, +∞ if none is. `panning_free`
/// is +∞ if every bias is free of panning, −∞ if none is. (Reports leave an infinite limit empty.)
struct BiasLimits {
    double allowance = 0;             ///< share of the scored pixels that may be wrong on each side
    std::uint64_t allowed_pixels = 0; ///< ⌊allowance · scored⌋

    /// Smallest bias at which the acne, summed over taps, is at most `allowed_pixels`.
    float acne_free = 0;
    /// Smallest bias with at most that many acne pixels, by side of one half.
    float acne_free_count = 0;
    float panning_free = 0; ///< largest bias with at most that many false-lit blocked pixels
    /// `panning_free` without the pixels that are false lit at bias 0 already. Those are edges and
    /// leaks, which no bias caused.
    float panning_free_beyond_zero = 0;

    /// Whether acne, by count, needs more bias than panning allows, or either limit cannot be met.
    [[nodiscard]] bool cross() const;
};

/// The limits: strict, and with allowances.
struct BiasBounds {
    BiasLimits strict;                    ///< no acne and no false-lit pixel
    std::array<BiasLimits, 3> allowances; ///< 0.01, 0.1 and 1 % of the scored pixels
    bool no_constant_bias_serves = false; ///< the limits cross at 0.1 %
};

/// The biases that detach shadows, regardless of other causes of false light.
struct PeterPanningLimit {
    /// The largest bias at which no pixel is peter-panning; +∞ if none ever is, −∞ if one always
    /// is.
    float free = 0;
    /// Blocked pixels that are lit at a bias of 0 already and have another label: edges, leaks.
    std::uint64_t lit_at_zero = 0;
};

/// Decides for each blocked pixel whether to forgive its gap (1) or not (0).
///
/// Called for pixels in ascending order of critical bias, as rarely as possible, since finding gaps
/// is expensive.
using ForgiveGaps = std::function<std::vector<std::uint8_t>(std::span<const std::size_t> pixels)>;

/// Finds the limits of the constant bias.
///
/// With allowances, a blocked pixel with a forgiven gap does not count as false lit. The strict
/// limits count every pixel.
/// @param curve      From the same critical biases and classes.
/// @param acne_free  Finds the lower limits.
/// @param forgive    Empty: forgives nothing.
/// @throws std::invalid_argument  if the images differ in size, or if `forgive` returns the wrong
///                                number of answers.
/// Source: docs/bias_curve.md#limits.
[[nodiscard]] BiasBounds find_bias_bounds(const BiasCurve& curve,
                                          const scene::Image<float>& criticals,
                                          const scene::Image<scene::PixelClass>& classes,
                                          const FindAcneFree& acne_free,
                                          const ForgiveGaps& forgive);

} // namespace gnomon::analysis
