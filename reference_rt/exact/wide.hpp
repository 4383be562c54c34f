#pragma once

#include "reference_rt/exact/interval.hpp"

#include <cmath>
#include <limits>

namespace gnomon::reference_rt {

/// A value held as the sum of two doubles, some 106 digits, and a bound of its distance from the
/// exact value: between `Bounded` and `Dyadic` in precision and cost. The inputs must be well
/// scaled.
struct Wide {
    double high = 0;
    double low = 0; ///< at most half an ulp of `high`
    double error = 0;

    [[nodiscard]] Interval rounded() const { return {high, std::abs(low) + error}; }
};

/// a + b and what its rounding lost, exactly. Source: Knuth, TAOCP 2, theorem 4.2.2B.
[[nodiscard]] inline Wide exact_sum(double a, double b)
{
    const double sum = a + b;
    const double added = sum - a;
    return {sum, (a - (sum - added)) + (b - added), 0};
}

/// The sum or product whose parts are `high` and, rounded, `low`.
[[nodiscard]] inline Wide joined(double high, double low, double error)
{
    const double sum = high + low;
    return {sum, low - (sum - high), error};
}

/// The low parts are below u times the high ones, and their few roundings below 8u² of these
/// (Joldes, Muller and Popescu, Tight and rigorous error bounds, prove less than half of it).
inline constexpr double wide_roundoff = 8 * unit_roundoff * unit_roundoff;

[[nodiscard]] inline Wide operator+(const Wide& a, const Wide& b)
{
    const Wide sum = exact_sum(a.high, b.high);
    return joined(sum.high, sum.low + (a.low + b.low),
                  a.error + b.error + wide_roundoff * (std::abs(a.high) + std::abs(b.high)));
}
[[nodiscard]] inline Wide operator-(const Wide& a, const Wide& b)
{
    return a + Wide{-b.high, -b.low, b.error};
}
[[nodiscard]] inline Wide operator*(const Wide& a, const Wide& b)
{
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product) + (a.high * b.low + a.low * b.high);
    // The factor covers what the low parts add to the sizes.
    return joined(product, rest,
                  1.01 * (std::abs(a.high) * b.error + (std::abs(b.high) + b.error) * a.error) +
                      wide_roundoff * std::abs(product));
}

/// Nothing is known of a quotient whose divisor may be 0.
[[nodiscard]] inline Wide operator/(const Wide& a, const Wide& b)
{
    const double start = a.high / b.high;
    const Wide rest = a - Wide{start, 0, 0} * b;
    const Wide quotient = joined(start, rest.high / b.high, 0);
    const double smallest = std::abs(b.high) - (std::abs(b.low) + b.error);
    if (!(smallest > 0)) {
        return {quotient.high, quotient.low, std::numeric_limits<double>::infinity()};
    }
    // |a'/b' − q| = |a' − qb'|/|b'|, and what is known of that remainder bounds it; the factor pays
    // for the roundings here, the summand for underflow.
    const Interval remainder = (a - quotient * b).rounded();
    return {quotient.high, quotient.low,
            1.01 * ((std::abs(remainder.value) + remainder.error) / smallest) + 0x1p-1000};
}

/// Arithmetic in twice double's precision, for the formulas of arithmetic.hpp.
struct WideField {
    [[nodiscard]] static Wide number(double x) { return {x, 0, 0}; }
    [[nodiscard]] static Wide difference(double a, double b) { return exact_sum(a, -b); }
};

} // namespace gnomon::reference_rt
