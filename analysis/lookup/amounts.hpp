#pragma once

#include "scene/pixels/truth.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>

namespace gnomon::analysis {

/// A scored pixel on the right side of one half is partial if its verdict differs from the truth by
/// more than this. Smaller differences count in amounts only. Source: docs/errors.md#amounts.
inline constexpr double partial_above = 1.0 / 256;

/// How far verdicts are from the truth. Complements the counts: a fractional verdict on the right
/// side of one half can still be wrong by nearly one half.
struct ErrorAmounts {
    double shadow = 0;         ///< Σ (1 − verdict) over the scored lit pixels [px]
    double light = 0;          ///< Σ verdict over the scored blocked pixels [px]
    std::uint64_t partial = 0; ///< pixels on the right side of one half that are still wrong
    double unassigned = 0; ///< the part of both amounts from right pixels that are not partial [px]

    [[nodiscard]] double total() const { return shadow + light; }
    ErrorAmounts& operator+=(const ErrorAmounts& other);
    friend bool operator==(const ErrorAmounts&, const ErrorAmounts&) = default;
};

/// A scored pixel's contribution to the sums.
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

/// A metric summed over scored pixels, besides the two amounts.
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

/// `ErrorAmounts` is measured, summed, listed and shown by these rows.
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

/// Adds up distances from the truth. Multiples of 1/taps are added as integers, so that neither
/// order nor rounding matters; others as doubles.
class AmountSum {
public:
    /// @param taps  0 if verdicts are arbitrary fractions.
    explicit AmountSum(int taps) : taps_{static_cast<double>(taps)} {}

    /// @param distance  |verdict − truth|, accurate to a float32.
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

/// The number of equal steps in which verdicts differ from the truth; 0 if they differ by arbitrary
/// fractions, as from partial light.
/// @param taps  Verdicts are multiples of 1/taps; 0: arbitrary fractions.
[[nodiscard]] inline int equal_steps(const scene::Truth& truth, int taps)
{
    return truth.shares.empty() ? taps : 0;
}

} // namespace gnomon::analysis
