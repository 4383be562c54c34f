#pragma once

#include "scene/pixels/truth.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>

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
    ErrorAmounts& operator+=(const ErrorAmounts& other);
    friend bool operator==(const ErrorAmounts&, const ErrorAmounts&) = default;
};

/// What a scored pixel adds to the sums.
struct ScoredPixel {
    scene::PixelClass truth = scene::PixelClass::lit;
    float verdict = 0;
    scene::VerdictError error;

    [[nodiscard]] constexpr bool is_right() const
    {
        return scene::is_lit(verdict) == scene::is_lit(truth);
    }
    [[nodiscard]] constexpr bool is_partial() const
    {
        return is_right() & (error.amount() > partial_above);
    }
};

/// A metric that scored pixels add up to, beside both amounts.
struct ErrorSum {
    std::variant<std::uint64_t ErrorAmounts::*, double ErrorAmounts::*> member; ///< pixels, or [px]
    double (*of)(const ScoredPixel&);
    std::string_view name;
    std::string_view meaning;
    std::string_view title = {};      ///< as in `MetricDescription`
    std::string_view table_note = {}; ///< as in `MetricDescription`

    [[nodiscard]] constexpr bool is_count() const
    {
        return std::holds_alternative<std::uint64_t ErrorAmounts::*>(member);
    }
};

/// What is measured, added up, listed and shown of `ErrorAmounts` follows from these rows.
inline constexpr auto error_sums = std::to_array<ErrorSum>({
    {&ErrorAmounts::partial,
     [](const ScoredPixel& pixel) { return pixel.is_partial() ? 1.0 : 0.0; }, "partial",
     "scored pixels on the right side of one half whose verdict is more than 1/256 from the truth",
     "partial [pixels]", "right by side, wrong by amount"},
    {&ErrorAmounts::unassigned,
     [](const ScoredPixel& pixel) {
         return pixel.error.amount() <= partial_above ? pixel.error.amount() : 0.0;
     },
     "unassigned", "the part of both amounts from right pixels that are not partial"},
});

inline ErrorAmounts& ErrorAmounts::operator+=(const ErrorAmounts& other)
{
    shadow += other.shadow;
    light += other.light;
    for (const ErrorSum& sum : error_sums) {
        std::visit([&](auto member) { this->*member += other.*member; }, sum.member);
    }
    return *this;
}

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
