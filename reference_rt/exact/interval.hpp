#pragma once

#include "reference_rt/exact/arithmetic.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::reference_rt {

/// A double and a bound of its error: for numeric results, as `Filtered` is for signs. Unlike a
/// permanent, the bound shrinks with the value. A bound that is not finite means unknown and may be
/// NaN, so test what is certain.
struct Interval {
    double value = 0;
    double error = 0;

    [[nodiscard]] double lower() const { return value - reach(); }
    [[nodiscard]] double upper() const { return value + reach(); }
    [[nodiscard]] bool is_certainly_positive() const { return value > error; }
    [[nodiscard]] bool is_certainly_negative() const { return value < -error; }

private:
    /// Covers its own roundings and that of the sum with the value.
    [[nodiscard]] double reach() const
    {
        return (1 + 0x1p-50) * (error + 2 * unit_roundoff * std::abs(value));
    }
};

/// A value rounded once, from terms with a total error of `error`.
[[nodiscard]] inline Interval rounded_once(double value, double error)
{
    // The factor covers up to ten roundings of the bound, the added term covers underflow.
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
/// The bound is infinite if the divisor may be 0.
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

/// Σ aᵢbᵢ, as if summed in twice the precision and rounded once, for any cancellation.
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

/// row·(point, weight), summed in double.
[[nodiscard]] inline Interval plain_row_at(const scene::Vec4d& row, const scene::Vec3d& point,
                                           double weight)
{
    const scene::Vec4d terms{row.x * point.x, row.y * point.y, row.z * point.z, row.w * weight};
    const double size =
        (std::abs(terms.x) + std::abs(terms.y)) + (std::abs(terms.z) + std::abs(terms.w));
    // A term is rounded as a product and in two sums; one more unit covers the roundings of `size`.
    return {(terms.x + terms.y) + (terms.z + terms.w), 4 * unit_roundoff * size + 0x1p-1000};
}

/// row·(point, weight): a matrix row at a point, or at infinity if the weight is 0.
[[nodiscard]] inline Interval row_at(const scene::Vec4d& row, const scene::Vec3d& point,
                                     double weight)
{
    return compensated_dot<4>({row.x, row.y, row.z, row.w}, {point.x, point.y, point.z, weight});
}

/// A double-double, about 106 bits, with a bound of its error: between `Interval` and `Dyadic` in
/// precision and cost. Inputs must be well scaled.
struct DoubleDouble {
    double high = 0;
    double low = 0; ///< at most half an ulp of `high`
    double error = 0;

    [[nodiscard]] Interval rounded() const { return {high, std::abs(low) + error}; }
};

/// The exact sum a + b, as the rounded sum and its error. Source: Knuth, TAOCP 2, theorem 4.2.2B.
[[nodiscard]] inline DoubleDouble exact_sum(double a, double b)
{
    const double sum = a + b;
    const double added = sum - a;
    return {sum, (a - (sum - added)) + (b - added), 0};
}

/// Normalises a result with parts `high` and `low`.
[[nodiscard]] inline DoubleDouble joined(double high, double low, double error)
{
    const double sum = high + low;
    return {sum, low - (sum - high), error};
}

/// Low parts are below u times the high ones, and their few roundings below 8u² times them. Joldes,
/// Muller and Popescu, Tight and rigorous error bounds, prove less than half of that.
inline constexpr double double_double_roundoff = 8 * unit_roundoff * unit_roundoff;

[[nodiscard]] inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b)
{
    const DoubleDouble sum = exact_sum(a.high, b.high);
    return joined(sum.high, sum.low + (a.low + b.low),
                  a.error + b.error +
                      double_double_roundoff * (std::abs(a.high) + std::abs(b.high)));
}
[[nodiscard]] inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b)
{
    return a + DoubleDouble{-b.high, -b.low, b.error};
}
[[nodiscard]] inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b)
{
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
    // The factor covers the low parts' share of the sizes.
    return joined(product, rest,
                  1.01 * (std::abs(a.high) * b.error + (std::abs(b.high) + b.error) * a.error) +
                      double_double_roundoff * std::abs(product));
}

/// The bound is infinite if the divisor may be 0.
[[nodiscard]] inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b)
{
    const double start = a.high / b.high;
    const DoubleDouble rest = a - DoubleDouble{start, 0, 0} * b;
    const DoubleDouble quotient = joined(start, rest.high / b.high, 0);
    const double smallest = std::abs(b.high) - (std::abs(b.low) + b.error);
    if (!(smallest > 0)) {
        return {quotient.high, quotient.low, std::numeric_limits<double>::infinity()};
    }
    // |a'/b' − q| = |a' − qb'|/|b'| is bounded by the remainder's interval. The factor covers the
    // roundings here, the added term covers underflow.
    const Interval remainder = (a - quotient * b).rounded();
    return {quotient.high, quotient.low,
            1.01 * ((std::abs(remainder.value) + remainder.error) / smallest) + 0x1p-1000};
}

/// Double-double arithmetic for the formulas of arithmetic.hpp.
struct DoubleDoubleField {
    [[nodiscard]] static DoubleDouble number(double x) { return {x, 0, 0}; }
    [[nodiscard]] static DoubleDouble difference(double a, double b) { return exact_sum(a, -b); }
};

} // namespace gnomon::reference_rt
