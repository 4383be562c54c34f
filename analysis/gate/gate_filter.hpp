#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/metrics/error_buckets.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// Neighbouring bands of light distance, both ends included.
struct LightDistanceBands {
    LightDistanceBand first;
    LightDistanceBand last;

    [[nodiscard]] bool has(LightDistanceBand band) const { return first <= band && band <= last; }
    friend bool operator==(const LightDistanceBands&, const LightDistanceBands&) = default;
};

/// Which pixels a metric counts: those that all of its members name.
struct PixelFilter {
    std::optional<std::string> object; ///< by its name
    std::optional<Cause> cause;
    std::optional<Label> label;
    std::optional<LightDistanceBands> bands;

    [[nodiscard]] bool takes_all() const { return !object && !cause && !label && !bands; }
    /// Whether it takes pixels of that cell, whatever their error.
    [[nodiscard]] bool has(const ErrorBucket& cell) const;
    /// Whether it takes errors of that kind, in whatever cell.
    [[nodiscard]] bool has(const KindOfError& kind) const;
    friend bool operator==(const PixelFilter&, const PixelFilter&) = default;
};

/// Whether a metric can be had of some pixels only: counts, amounts and rates of errors, causes and
/// labels, `pixels.lit` and `pixels.blocked`.
[[nodiscard]] bool is_of_pixels(std::string_view metric);

/// The errors that a metric counts or adds up, of the pixels that the filter takes.
/// @return  Empty if the metric counts no errors, or contradicts the filter.
[[nodiscard]] std::optional<PixelFilter> counted_pixels(std::string_view metric,
                                                        const PixelFilter& filter);

/// Whether a metric of errors counts false lit pixels, or else false shadow; one of both sides
/// counts either.
[[nodiscard]] bool counts_side(std::string_view metric, bool is_false_lit);

/// Whether any error can be of that metric and filter: acne, for one, is never false lit
/// (docs/causes.md). Metrics that count right pixels too take no cause or label.
[[nodiscard]] bool can_count(std::string_view metric, const PixelFilter& filter);

/// That metric of the pixels that the filter takes.
/// @param metric  `is_of_pixels`.
/// @return  Empty if no cell is such: there are no such pixels, or cells are not known; or if a
///          rate's denominator is 0.
[[nodiscard]] std::optional<double> metric_of_pixels(const std::vector<ErrorBucket>& cells,
                                                     std::string_view metric,
                                                     const PixelFilter& filter);

} // namespace gnomon::analysis
