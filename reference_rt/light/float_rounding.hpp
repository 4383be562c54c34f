#pragma once

#include "reference_rt/exact/contact.hpp"
#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/wide.hpp"
#include "reference_rt/light/light_depth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

/// How an exact number becomes a float32, decided in the least precision that leaves no doubt.
///
/// A rule of rounding is monotone. It says which float32 a double becomes, and from which number on
/// one float32 gives way to the next: such a boundary is a double, so that the rule says for it,
/// too, what it becomes.
namespace gnomon::reference_rt {

/// To the nearest float32, ties to even, as IEEE 754 rounds once: what is not below 2^128 − 2^103
/// becomes infinite. Results that would be subnormal, those of numbers below 2^-126 − 2^-150, are
/// 0, which is positive: threads in which Embree has set the processor to flush them, and threads
/// in which it has not, agree.
struct ToNearest {
    [[nodiscard]] static float of(double x)
    {
        const double size = std::abs(x);
        if (size < first_normal) {
            return 0;
        }
        // Not converted from below the normal numbers: a thread that flushes has 0 there.
        return static_cast<float>(size < 0x1p-126 ? std::copysign(0x1p-126, x) : x);
    }
    [[nodiscard]] static double boundary(float lower, float upper)
    {
        if (lower == 0 || upper == 0) {
            return std::copysign(first_normal, static_cast<double>(lower + upper));
        }
        // Exact for neighbours; beyond the largest float32 the next one would be 2^128.
        const auto number = [](float x) {
            return std::clamp(static_cast<double>(x), -0x1p128, 0x1p128);
        };
        return (number(lower) + number(upper)) / 2;
    }

private:
    /// Half way from the largest subnormal to the smallest normal float32, which is even.
    static constexpr double first_normal = 0x1p-126 - 0x1p-150;
};

/// The float32s between which a number within bounds is rounded: equal, or else neighbours.
template <typename Rule>
struct RoundedEnds {
    explicit RoundedEnds(const Interval& x) : lower{Rule::of(x.lower())}, upper{Rule::of(x.upper())}
    {
    }

    [[nodiscard]] bool are_equal() const { return lower == upper; }
    [[nodiscard]] double boundary() const { return Rule::boundary(lower, upper); }

    float lower, upper;
};

/// The float32 where the whole interval becomes the same.
template <typename Rule>
[[nodiscard]] std::optional<float> certainly_rounded(const Interval& x)
{
    const RoundedEnds<Rule> ends{x};
    return ends.are_equal() ? std::optional{ends.lower} : std::nullopt;
}

/// The float32 where the sum of both parts, within their error, leaves no doubt.
template <typename Rule>
[[nodiscard]] std::optional<float> certainly_rounded(const Wide& x)
{
    const Interval rounded = x.rounded();
    const RoundedEnds<Rule> ends{rounded};
    if (ends.are_equal()) {
        return ends.lower;
    }
    if (!(rounded.error <= 0x1p-50 * std::abs(rounded.value))) {
        return std::nullopt;
    }
    // Between two boundaries there are many doubles: only one is within the error.
    const Interval beyond = (x - WideField::number(ends.boundary())).rounded();
    if (beyond.is_certainly_positive()) {
        return ends.upper;
    }
    return beyond.is_certainly_negative() ? std::optional{ends.lower} : std::nullopt;
}

/// The float32 that an exact number becomes: a quotient, whose denominator is not 0, or made of
/// roots.
template <typename Rule, typename Number>
[[nodiscard]] float exactly_rounded(const Number& x)
{
    if (x.sign() == 0) {
        return Rule::of(0);
    }
    // Far beyond all float32s all numbers are alike; the summand pays for underflow.
    const double value = std::clamp(x.value(), -0x1p1000, 0x1p1000);
    const RoundedEnds<Rule> ends{
        Interval{value, Number::relative_error * std::abs(value) + 0x1p-1000}};
    if (ends.are_equal()) {
        return ends.lower;
    }
    // As above: there is no other boundary within the error.
    const double boundary = ends.boundary();
    const Sign side = x.sign_beyond(boundary);
    return side == 0 ? Rule::of(boundary) : side > 0 ? ends.upper : ends.lower;
}

} // namespace gnomon::reference_rt
