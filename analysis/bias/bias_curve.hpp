#pragma once

#include "analysis/lookup/bias_order.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Wrong pixels of one verdict image.
struct ErrorCounts {
    std::uint64_t false_shadow = 0; ///< truth lit, verdict shadowed
    std::uint64_t false_lit = 0;    ///< truth blocked, verdict lit

    [[nodiscard]] std::uint64_t total() const { return false_shadow + false_lit; }
    friend bool operator==(const ErrorCounts&, const ErrorCounts&) = default;
};

/// Biases lo <= b <= hi. An infinite end means no limit on that side.
struct BiasInterval {
    float lo = 0;
    float hi = 0;

    /// hi − lo; infinite if an end is.
    [[nodiscard]] double width() const { return double{hi} - double{lo}; }
    /// The bias nearest the middle: the rounded mean of a finite interval's ends, the finite end of
    /// a half-infinite one, 0 of an infinite one.
    [[nodiscard]] float middle() const;
    friend bool operator==(const BiasInterval&, const BiasInterval&) = default;
};

/// Calls `visit(interval, errors)` for each interval of biases with equal counts, in ascending
/// order from −∞ to +∞.
/// @param lit, blocked  Critical biases of scored pixels, ascending.
template <typename Visit>
void for_each_interval(std::span<const float> lit, std::span<const float> blocked,
                       const Visit& visit)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    auto next_lit = std::upper_bound(lit.begin(), lit.end(), -infinity);
    auto next_blocked = std::upper_bound(blocked.begin(), blocked.end(), -infinity);
    const auto errors = [&] {
        return ErrorCounts{static_cast<std::uint64_t>(lit.end() - next_lit),
                           static_cast<std::uint64_t>(next_blocked - blocked.begin())};
    };
    float lo = -infinity;
    while (true) {
        const float next = std::min(next_lit != lit.end() ? *next_lit : infinity,
                                    next_blocked != blocked.end() ? *next_blocked : infinity);
        if (next == infinity) {
            visit(BiasInterval{lo, infinity}, errors());
            return;
        }
        visit(BiasInterval{lo, previous_bias(next)}, errors());
        while (next_lit != lit.end() && *next_lit == next) {
            ++next_lit;
        }
        while (next_blocked != blocked.end() && *next_blocked == next) {
            ++next_blocked;
        }
        lo = next;
    }
}

/// The exact error counts at every constant bias, for one lookup and slope.
///
///     false shadow(b) = scored lit pixels with critical bias > b
///     false lit(b)    = scored blocked pixels with critical bias <= b
///
/// Source: docs/bias_curve.md#the-curve.
class BiasCurve {
public:
    /// Sorts the critical biases of the scored pixels.
    /// @throws std::invalid_argument  if the images differ in size, or if a scored pixel's critical
    ///                                bias is NaN.
    BiasCurve(const scene::Image<float>& criticals, const scene::Image<scene::PixelClass>& classes);

    /// @param bias  0 or a normal float32.
    /// @throws std::invalid_argument  for other values, which no lookup accepts.
    [[nodiscard]] ErrorCounts at(float bias) const;

    /// Critical biases of the scored pixels, ascending, including infinite ones.
    [[nodiscard]] const std::vector<float>& lit() const { return lit_; }
    [[nodiscard]] const std::vector<float>& blocked() const { return blocked_; }
    [[nodiscard]] std::uint64_t scored() const { return lit_.size() + blocked_.size(); }

    /// Errors / scored pixels; empty without scored pixels.
    [[nodiscard]] std::optional<double> error_rate(const ErrorCounts& errors) const;
    /// False shadow / scored lit pixels; empty without lit pixels.
    [[nodiscard]] std::optional<double> false_shadow_rate(const ErrorCounts& errors) const;
    /// False lit / scored blocked pixels; empty without blocked pixels.
    [[nodiscard]] std::optional<double> false_lit_rate(const ErrorCounts& errors) const;

private:
    std::vector<float> lit_;
    std::vector<float> blocked_;
};

/// The biases with the fewest errors.
struct BestBiases {
    BiasInterval interval; ///< the widest; of equally wide ones the lowest
    ErrorCounts errors;    ///< at its lower end

    /// The bias to recommend, from an interval within [0, 1]: the middle, or the lower end if
    /// nothing limits the upper one.
    [[nodiscard]] float recommended() const
    {
        return interval.hi >= 1.0F ? interval.lo : interval.middle();
    }
};

/// Whether a is better than b: fewer errors, or equally many over a wider interval.
[[nodiscard]] bool is_better(const BestBiases& a, const BestBiases& b);

/// All biases.
inline constexpr BiasInterval every_bias{-std::numeric_limits<float>::infinity(),
                                         std::numeric_limits<float>::infinity()};

/// The longest interval of biases that all have the fewest errors.
///
/// `lo` is a critical bias or −∞. `hi` is the last bias before errors increase, or +∞. Of several
/// intervals, returns the widest; of equally wide ones, the lowest.
/// @param within  Range to search; an end of it may be an end of the interval found.
/// @throws std::invalid_argument  if its ends are in the wrong order.
[[nodiscard]] BestBiases find_best_biases(const BiasCurve& curve,
                                          const BiasInterval& within = every_bias);

/// The biases with at most this many wrong pixels of each kind; empty if no bias qualifies.
[[nodiscard]] std::optional<BiasInterval> biases_with_at_most(const BiasCurve& curve,
                                                              const ErrorCounts& most);

/// One bias and its exact counts.
struct CurvePoint {
    float bias = 0;
    ErrorCounts errors;

    friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// The Pareto-optimal biases, ascending: no other bias has fewer errors of one kind without more of
/// the other. One for each pair of counts, the smallest that gives it (the largest, for counts that
/// hold for every small bias).
/// @param most_points  >= 2. If there are more points, keeps both extremes and others evenly spaced
///                     in their order.
/// @throws std::invalid_argument  if `most_points` < 2.
[[nodiscard]] std::vector<CurvePoint> pareto_front(const BiasCurve& curve, std::size_t most_points);

/// Biases spread over the curve's range, ascending, for tables and plots. They include 0 and one
/// just below the first critical bias. If the critical biases are few, they include all of them.
/// Otherwise half are evenly spaced among the pixels' critical biases (so that few pixels change
/// between neighbours), and half logarithmically over the positive ones.
/// @param most_points  >= 8.
/// @throws std::invalid_argument  if `most_points` < 8.
[[nodiscard]] std::vector<float> sample_biases(const BiasCurve& curve,
                                               std::size_t most_points = 2048);

} // namespace gnomon::analysis
