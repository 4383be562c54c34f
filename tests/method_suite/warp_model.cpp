#include "warp_model.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::tests {

double Warp::operator()(double depth) const
{
    return std::exp(exponent * (reversed ? -1.0 : 1.0) * (2 * depth - 1));
}

double Warp::error() const
{
    return (3.5 * std::abs(exponent) + 5) * 0x1p-24;
}

MomentErrors MomentErrors::of_blur(const Warp& warp, int width_texels)
{
    return {warp.error(), (1 + 2 * (3 + (width_texels + 1) / 2.0) + 4) * 0x1p-24};
}

MomentErrors MomentErrors::of_interpolation()
{
    return {0, 4 * 0x1p-24};
}

namespace {

double chebyshev(const Warp& warp, double variance, double beyond, double reference)
{
    if (beyond <= 0) {
        return 1;
    }
    const double scale = 2 * warp.exponent * reference * warp.least_deviation;
    const double at_least = std::max(variance, scale * scale);
    return at_least / (at_least + beyond * beyond);
}

} // namespace

WarpBound warp_bound(const Warp& warp, const BlurredNumber& first, const BlurredNumber& second,
                     const MomentErrors& errors, double receiver_depth)
{
    const double m1 = first.value;
    const double m2 = second.value;
    const double variance = std::max(m2 - m1 * m1, 0.0);
    const double reference = warp(receiver_depth);
    const double largest = std::max(reference, std::sqrt(m2));
    const double off = 2 * std::sqrt(variance * m2) * errors.of_warps +
                       m2 * errors.of_warps * errors.of_warps +
                       (3 * errors.in_sums + 2 * 0x1p-24) * m2 +
                       interpolation_error() * (second.spread + 2 * m1 * first.spread);
    const double beyond = warp.exponent > 0 ? reference - m1 : m1 - reference;
    const double beyond_off =
        (errors.of_warps + warp.error() + errors.in_sums + 0x1p-24) * largest +
        interpolation_error() * first.spread;
    return {chebyshev(warp, variance - off, beyond + beyond_off, reference),
            chebyshev(warp, variance + off, beyond - beyond_off, reference)};
}

} // namespace gnomon::tests
