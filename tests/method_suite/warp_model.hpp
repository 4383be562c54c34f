#pragma once

#include "blur_model.hpp"

namespace gnomon::tests {

/// One of an exponential variance map's two warps of depths: e^(c·y) of y in [−1, 1].
struct Warp {
    double exponent = 0; ///< c; negative: the negative warp, whose sign is left away
    bool reversed = false;
    double least_deviation = 0; ///< of depths

    [[nodiscard]] double operator()(double depth) const;
    /// In parts of a warp, by how much GL may be off: its exponent's two products round, and so
    /// does what becomes of the depth.
    [[nodiscard]] double error() const;
};

/// Between what Chebyshev's bound is, by how far GL may be off.
struct WarpBound {
    double low = 0;
    double high = 0;
};

/// By how much moments may be off, in parts of the second one.
struct MomentErrors {
    double of_warps = 0; ///< of each warp that is averaged
    double in_sums = 0;  ///< of each sum

    /// Of a map that GL made of depths. Of each moment, in units of 2^-24: in either pass the
    /// weight 1, the sum of two texels 1, the product 1, and (w + 1)/2 sums; the interpolation 4.
    [[nodiscard]] static MomentErrors of_blur(const Warp& warp, int width_texels);
    /// Of a map that was read back: the interpolation alone.
    [[nodiscard]] static MomentErrors of_interpolation();
};

/// The variance of warps that are off by a is off by 2σa + a²; M₂ − M₁² is off by three times the
/// error of sums, and two roundings.
[[nodiscard]] WarpBound warp_bound(const Warp& warp, const BlurredNumber& first,
                                   const BlurredNumber& second, const MomentErrors& errors,
                                   double receiver_depth);

} // namespace gnomon::tests
