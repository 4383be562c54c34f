#pragma once

#include "blur_model.hpp"

namespace gnomon::tests {

/// One of an exponential variance map's two warps of depths: e^(c·y) of y in [−1, 1].
struct Warp {
    double exponent = 0; ///< c; negative for the negative warp, whose sign is omitted
    bool reversed = false;
    double least_deviation = 0; ///< of depths

    [[nodiscard]] double operator()(double depth) const;
    /// GL's largest relative error of a warp: its exponent's two products and the depth conversion
    /// round.
    [[nodiscard]] double error() const;
};

/// Bounds on Chebyshev's bound, given GL's errors.
struct WarpBound {
    double low = 0;
    double high = 0;
};

/// Largest errors of the moments, relative to the second one.
struct MomentErrors {
    double of_warps = 0; ///< of each warp that is averaged
    double in_sums = 0;  ///< of each sum

    /// For a map that GL computed from depths. Each moment, in units of 2^-24: in either pass the
    /// weight 1, the sum of two texels 1, the product 1, and (w + 1)/2 sums; the interpolation 4.
    [[nodiscard]] static MomentErrors of_blur(const Warp& warp, int width_texels);
    /// For a map that was read back: only the interpolation.
    [[nodiscard]] static MomentErrors of_interpolation();
};

/// If warps err by a, their variance errs by 2σa + a². M₂ − M₁² errs by three times the error of
/// sums, and two roundings.
[[nodiscard]] WarpBound warp_bound(const Warp& warp, const BlurredNumber& first,
                                   const BlurredNumber& second, const MomentErrors& errors,
                                   double receiver_depth);

} // namespace gnomon::tests
