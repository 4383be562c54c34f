#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/interval.hpp"
#include "reference_rt/light/light_depth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

/// Rounds exact numbers to float32, in the lowest precision that decides.
///
/// A rounding rule is monotonic. It maps a double to a float32, and gives the boundary between
/// neighbouring float32 results. Boundaries are doubles, so the rule also rounds them.
namespace gnomon::reference_rt {

/// Rounds to the nearest float32, ties to even, as IEEE 754; numbers from 2^128 − 2^103 become
/// infinite. Subnormal results, those of numbers below 2^-126 − 2^-150, become +0, so that threads
/// with and without Embree's flush-to-zero mode agree.
struct ToNearest {
    [[nodiscard]] static float of(double x)
    {
        const double size = std::abs(x);
        if (size < first_normal) {
            return 0;
        }
        // Never converts subnormal numbers, which threads in flush-to-zero mode turn into 0.
        return static_cast<float>(size < 0x1p-126 ? std::copysign(0x1p-126, x) : x);
    }
    [[nodiscard]] static double boundary(float lower, float upper)
    {
        if (lower == 0 || upper == 0) {
            return std::copysign(first_normal, static_cast<double>(lower + upper));
        }
        // Exact for neighbours; 2^128 follows the largest float32.
        const auto number = [](float x) {
            return std::clamp(static_cast<double>(x), -0x1p128, 0x1p128);
        };
        return (number(lower) + number(upper)) / 2;
    }

private:
    /// Midpoint of the largest subnormal and the smallest normal float32, which is even.
    static constexpr double first_normal = 0x1p-126 - 0x1p-150;
};

/// The rounded ends of an interval: equal, or neighbours.
template <typename Rule>
struct RoundedEnds {
    explicit RoundedEnds(const Interval& x) : lower{Rule::of(x.lower())}, upper{Rule::of(x.upper())}
    {
    }

    [[nodiscard]] bool are_equal() const { return lower == upper; }
    [[nodiscard]] double boundary() const { return Rule::boundary(lower, upper); }

    float lower, upper;
};

/// The float32, if the whole interval rounds to the same one.
template <typename Rule>
[[nodiscard]] std::optional<float> certainly_rounded(const Interval& x)
{
    const RoundedEnds<Rule> ends{x};
    return ends.are_equal() ? std::optional{ends.lower} : std::nullopt;
}

/// The float32, if the double-double decides it within its error.
template <typename Rule>
[[nodiscard]] std::optional<float> certainly_rounded(const DoubleDouble& x)
{
    const Interval rounded = x.rounded();
    const RoundedEnds<Rule> ends{rounded};
    if (ends.are_equal()) {
        return ends.lower;
    }
    if (!(rounded.error <= 0x1p-50 * std::abs(rounded.value))) {
        return std::nullopt;
    }
    // Boundaries are many doubles apart, so at most one is within the error.
    const Interval beyond = (x - DoubleDoubleField::number(ends.boundary())).rounded();
    if (beyond.is_certainly_positive()) {
        return ends.upper;
    }
    return beyond.is_certainly_negative() ? std::optional{ends.lower} : std::nullopt;
}

/// Rounds an exact number: a quotient with a denominator other than 0, or an expression with roots.
template <typename Rule, typename Number>
[[nodiscard]] float exactly_rounded(const Number& x)
{
    if (x.sign() == 0) {
        return Rule::of(0);
    }
    // All numbers far beyond float32 round alike. The added term covers underflow.
    const double value = std::clamp(x.value(), -0x1p1000, 0x1p1000);
    const RoundedEnds<Rule> ends{
        Interval{value, Number::relative_error * std::abs(value) + 0x1p-1000}};
    if (ends.are_equal()) {
        return ends.lower;
    }
    // As above, no other boundary is within the error.
    const double boundary = ends.boundary();
    const Sign side = x.sign_beyond(boundary);
    return side == 0 ? Rule::of(boundary) : side > 0 ? ends.upper : ends.lower;
}

} // namespace gnomon::reference_rt
