#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/limits/acne_free.hpp"

#include <array>
#include <functional>
#include <span>

namespace gnomon::analysis {

/// The two limits between which a constant bias must lie, also where they are infinite: a bias is
/// free of acne iff it is at least `acne_free`, free of panning iff it is at most `panning_free`.
///
/// `acne_free`, of either kind, is −∞ when every bias is, +∞ when none is; `panning_free` is +∞
/// when every bias is, −∞ when none is. (Reports write an infinite limit as empty: there is no such
/// bias to name.)
struct BiasLimits {
    double allowance = 0;             ///< share of the scored pixels that may be wrong on each side
    std::uint64_t allowed_pixels = 0; ///< ⌊allowance · scored⌋

    /// Smallest bias with an amount of acne of at most `allowed_pixels`, tap by tap.
    float acne_free = 0;
    float acne_free_count = 0; ///< with at most that many acne pixels, by side of one half
    float panning_free = 0;    ///< largest bias with at most that many false-lit blocked pixels
    /// The same without the pixels that are already false lit at bias 0: they are edges and leaks,
    /// and no bias brought them about.
    float panning_free_beyond_zero = 0;

    /// Whether acne, by count, needs more bias than panning allows, or no bias serves one of them.
    [[nodiscard]] bool cross() const;
};

/// Strictly, and with allowances.
struct BiasBounds {
    BiasLimits strict;                    ///< no acne, and literally no false-lit pixel
    std::array<BiasLimits, 3> allowances; ///< 0.01, 0.1 and 1 % of the scored pixels
    bool no_constant_bias_serves = false; ///< the limits cross at 0.1 %
};

/// Which biases detach shadows, whatever else lights blocked pixels.
struct PeterPanningLimit {
    /// The largest bias with which no pixel is called peter-panning; +∞ where none ever is, −∞
    /// where one always is.
    float free = 0;
    /// Blocked pixels that are lit at a bias of 0 already, and called something else: edges, leaks.
    std::uint64_t lit_at_zero = 0;
};

/// Says of each blocked pixel whether its gap may be forgiven (1) or not (0).
///
/// Asked for pixels in ascending order of critical bias, in as few pieces as are needed, for
/// finding gaps is expensive.
using ForgiveGaps = std::function<std::vector<std::uint8_t>(std::span<const std::size_t> pixels)>;

/// What limits the constant bias from below and from above.
///
/// For the allowances a blocked pixel with a forgiven gap does not count as false lit; strictly
/// every one counts.
/// @param curve      Made of the same critical biases and classes.
/// @param acne_free  What acne needs.
/// @param forgive    Empty: nothing is forgiven.
/// @throws std::invalid_argument  if the images differ in size, or `forgive` answers for another
///                                number of pixels than it was asked about.
/// Source: docs/bias_curve.md#limits.
[[nodiscard]] BiasBounds find_bias_bounds(const BiasCurve& curve,
                                          const scene::Image<float>& criticals,
                                          const scene::Image<scene::PixelClass>& classes,
                                          const FindAcneFree& acne_free,
                                          const ForgiveGaps& forgive);

} // namespace gnomon::analysis
