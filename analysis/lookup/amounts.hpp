#pragma once

#include "scene/pixels/truth.hpp"

#include <cmath>
#include <cstdint>

namespace gnomon::analysis {

/// A scored pixel on the right side of one half is partial when its verdict is further from the
/// truth than this; a smaller difference enters amounts only. Source: docs/errors.md#amounts.
inline constexpr double partial_above = 1.0 / 256;

/// By how much verdicts differ from the truth, beside how often: where a verdict is a fraction, a
/// pixel on the right side of one half can be wrong by nearly one half.
struct ErrorAmounts {
    double shadow = 0;         ///< Σ (1 − verdict) over the scored lit pixels [px]
    double light = 0;          ///< Σ verdict over the scored blocked pixels [px]
    std::uint64_t partial = 0; ///< pixels on the right side of one half, yet not right
    double unassigned = 0;     ///< the part of both from right pixels that are not partial [px]

    [[nodiscard]] double total() const { return shadow + light; }
    ErrorAmounts& operator+=(const ErrorAmounts& other)
    {
        shadow += other.shadow;
        light += other.light;
        partial += other.partial;
        unassigned += other.unassigned;
        return *this;
    }
    friend bool operator==(const ErrorAmounts&, const ErrorAmounts&) = default;
};

/// Adds up distances from the truth: verdicts that are multiples of 1/taps as integers, so that no
/// order and no rounding matters, others as doubles.
class AmountSum {
public:
    /// @param taps  0: verdicts are any fractions.
    explicit AmountSum(int taps) : taps_{static_cast<double>(taps)} {}

    /// @param distance  |verdict − truth|, with a float32's error.
    void add(double distance)
    {
        taps_sum_ += std::llrint(distance * taps_);
        sum_ += distance;
    }
    void add(const AmountSum& other)
    {
        taps_sum_ += other.taps_sum_;
        sum_ += other.sum_;
    }
    [[nodiscard]] double value() const
    {
        return taps_ > 0 ? static_cast<double>(taps_sum_) / taps_ : sum_;
    }

private:
    double taps_;
    std::int64_t taps_sum_ = 0;
    double sum_ = 0;
};

/// In how many equal steps verdicts differ from the truth; 0: by any fraction, as from a share of
/// the light that is neither 0 nor 1.
/// @param taps  the verdicts are multiples of 1/taps; 0: any fractions.
[[nodiscard]] inline int equal_steps(const scene::Truth& truth, int taps)
{
    return truth.shares.empty() ? taps : 0;
}

} // namespace gnomon::analysis
