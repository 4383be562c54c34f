#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::reference_rt {

/// A double, and a bound of its distance from the exact value: for results that are numbers, where
/// `Filtered` is for signs. Unlike a permanent, the bound shrinks with the value. A bound that is
/// not finite says that nothing is known; it may be NaN, so ask what is certain, never what is not.
struct Interval {
    double value = 0;
    double error = 0;

    [[nodiscard]] double lower() const { return value - reach(); }
    [[nodiscard]] double upper() const { return value + reach(); }
    [[nodiscard]] bool is_certainly_positive() const { return value > error; }
    [[nodiscard]] bool is_certainly_negative() const { return value < -error; }

private:
    /// Pays for its own roundings and that of the sum with the value.
    [[nodiscard]] double reach() const
    {
        return (1 + 0x1p-50) * (error + 2 * unit_roundoff * std::abs(value));
    }
};

/// A value that was rounded once after terms known up to `error`.
[[nodiscard]] inline Interval rounded_once(double value, double error)
{
    // The factor pays for the up to ten roundings of the bound, the summand for underflow.
    return {value, (1 + 0x1p-49) * (error + unit_roundoff * std::abs(value)) + 0x1p-1000};
}
[[nodiscard]] inline Interval operator+(const Interval& a, const Interval& b)
{
    return rounded_once(a.value + b.value, a.error + b.error);
}
[[nodiscard]] inline Interval operator-(const Interval& a, const Interval& b)
{
    return rounded_once(a.value - b.value, a.error + b.error);
}
[[nodiscard]] inline Interval operator*(const Interval& a, const Interval& b)
{
    return rounded_once(a.value * b.value,
                        a.error * std::abs(b.value) + (std::abs(a.value) + a.error) * b.error);
}
/// Nothing is known of a quotient whose divisor may be 0.
[[nodiscard]] inline Interval operator/(const Interval& a, const Interval& b)
{
    const double quotient = a.value / b.value;
    const double smallest = std::abs(b.value) - b.error;
    if (!(smallest > 0)) {
        return {quotient, std::numeric_limits<double>::infinity()};
    }
    // |a'/b' − a/b| <= (|a' − a| + |a/b||b' − b|)/|b'|
    return rounded_once(quotient, (a.error + std::abs(quotient) * b.error) / smallest);
}

/// Σ aᵢbᵢ as if summed in twice the precision and rounded once, however the terms cancel.
/// Source: Ogita, Rump and Oishi, Accurate Sum and Dot Product, algorithm 5.3 and proposition 5.5.
template <std::size_t n>
[[nodiscard]] Interval compensated_dot(const std::array<double, n>& a,
                                       const std::array<double, n>& b)
{
    static_assert(n <= 8);
    double sum = 0;
    double rest = 0;
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double product = a[i] * b[i];
        const double product_rest = std::fma(a[i], b[i], -product);
        const double next = sum + product;
        const double step = next - sum;
        rest += ((sum - (next - step)) + (product - step)) + product_rest;
        sum = next;
        size += std::abs(product);
    }
    // γ_n² Σ|aᵢbᵢ| <= 2^-99 Σ|aᵢbᵢ| for n = 8
    return rounded_once(sum + rest, 0x1p-99 * size);
}

/// row·(point, weight), summed in double: for a start.
[[nodiscard]] inline Interval plain_row_at(const scene::Vec4d& row, const scene::Vec3d& point,
                                           double weight)
{
    const scene::Vec4d terms{row.x * point.x, row.y * point.y, row.z * point.z, row.w * weight};
    const double size =
        (std::abs(terms.x) + std::abs(terms.y)) + (std::abs(terms.z) + std::abs(terms.w));
    // A term is rounded as a product and in two sums; the third unit pays for those of `size`.
    return {(terms.x + terms.y) + (terms.z + terms.w), 4 * unit_roundoff * size + 0x1p-1000};
}

/// row·(point, weight): a row of a matrix at a point, or at infinity with weight 0.
[[nodiscard]] inline Interval row_at(const scene::Vec4d& row, const scene::Vec3d& point,
                                     double weight)
{
    return compensated_dot<4>({row.x, row.y, row.z, row.w}, {point.x, point.y, point.z, weight});
}

} // namespace gnomon::reference_rt
