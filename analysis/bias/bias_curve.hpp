#pragma once

#include "analysis/bias/bias_intervals.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The error counts of every constant bias, exactly: the curve of one slope, and of
/// one lookup where other biases move it.
///
///     false shadow(b) = scored lit pixels with critical bias > b
///     false lit(b)    = scored blocked pixels with critical bias <= b
///
/// Source: docs/bias_curve.md#the-curve.
class BiasCurve {
public:
    /// Sorts the critical biases of the scored pixels.
    /// @throws std::invalid_argument  if the images differ in size, or a scored pixel's critical
    ///                                bias is NaN.
    BiasCurve(const scene::Image<float>& criticals, const scene::Image<scene::PixelClass>& classes);

    /// @param bias  0 or a normal float32.
    /// @throws std::invalid_argument  for other values: no lookup takes them.
    [[nodiscard]] ErrorCounts at(float bias) const;

    /// Critical biases of the scored pixels, ascending, infinite ones included.
    [[nodiscard]] const std::vector<float>& lit() const { return lit_; }
    [[nodiscard]] const std::vector<float>& blocked() const { return blocked_; }
    [[nodiscard]] std::uint64_t scored() const { return lit_.size() + blocked_.size(); }

    /// Errors over scored pixels; empty if there are none.
    [[nodiscard]] std::optional<double> error_rate(const ErrorCounts& errors) const;
    /// False shadow over scored lit pixels; empty if there are none.
    [[nodiscard]] std::optional<double> false_shadow_rate(const ErrorCounts& errors) const;
    /// False lit over scored blocked pixels; empty if there are none.
    [[nodiscard]] std::optional<double> false_lit_rate(const ErrorCounts& errors) const;

private:
    std::vector<float> lit_;
    std::vector<float> blocked_;
};

/// The biases with the fewest errors.
struct BestBiases {
    BiasInterval interval; ///< of several the widest, of those the lowest
    ErrorCounts errors;    ///< at its lower end

    /// The bias to take of them, looked for in [0, 1]: the middle; the lower end where nothing sets
    /// an upper one.
    [[nodiscard]] float recommended() const
    {
        return interval.hi >= 1.0F ? interval.lo : interval.middle();
    }
};

/// Whether a is better than b: fewer errors, or as many over a wider interval.
[[nodiscard]] bool is_better(const BestBiases& a, const BestBiases& b);

/// All biases.
inline constexpr BiasInterval every_bias{-std::numeric_limits<float>::infinity(),
                                         std::numeric_limits<float>::infinity()};

/// The longest interval of biases that all have the fewest errors.
///
/// `lo` is a critical bias, or −∞; `hi` is the last bias before the critical bias from which on
/// there are more errors, or +∞. Of several intervals it is the widest, of those the lowest.
/// @param within  where the biases are looked for; an end of it may be an end of the interval
/// found.
/// @throws std::invalid_argument  if its ends are in the wrong order.
[[nodiscard]] BestBiases find_best_biases(const BiasCurve& curve,
                                          const BiasInterval& within = every_bias);

/// The biases with at most so many wrong pixels of each kind; empty if there is none.
[[nodiscard]] std::optional<BiasInterval> biases_with_at_most(const BiasCurve& curve,
                                                              const ErrorCounts& most);

/// One bias and its exact counts.
struct CurvePoint {
    float bias = 0;
    ErrorCounts errors;

    friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

/// The biases of which no other has fewer errors of one kind without more of the other, in
/// ascending order: one for each pair of counts, the smallest that gives it (the largest, for
/// counts that hold for every small bias).
/// @param most_points  If there are more, this many of them: both extremes, and others evenly
///                     spaced in their order; >= 2.
/// @throws std::invalid_argument  if `most_points` < 2.
[[nodiscard]] std::vector<CurvePoint> pareto_front(const BiasCurve& curve, std::size_t most_points);

/// Biases spread over the curve's range, ascending, for tables and plots: just below the first
/// critical bias, 0, every critical bias if they are few, and else half of the points evenly spaced
/// among the pixels' critical biases (so that few pixels change between neighbours) and half
/// logarithmically spaced over the positive ones.
/// @param most_points  >= 8.
/// @throws std::invalid_argument  if `most_points` < 8.
[[nodiscard]] std::vector<float> sample_biases(const BiasCurve& curve,
                                               std::size_t most_points = 2048);

} // namespace gnomon::analysis
