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

/// The pixels that a metric counts: those that match every given member.
struct PixelFilter {
    std::optional<std::string> object; ///< by its name
    std::optional<Cause> cause;
    std::optional<Label> label;
    std::optional<LightDistanceBands> bands;

    [[nodiscard]] bool takes_all() const { return !object && !cause && !label && !bands; }
    /// Whether it takes pixels of that cell, whatever their error.
    [[nodiscard]] bool has(const ErrorBucket& cell) const;
    /// Whether it takes errors of that kind, in any cell.
    [[nodiscard]] bool has(const KindOfError& kind) const;
    friend bool operator==(const PixelFilter&, const PixelFilter&) = default;
};

/// Whether a metric can be restricted to some pixels: counts, amounts and rates of errors, causes
/// and labels, `pixels.lit` and `pixels.blocked`.
[[nodiscard]] bool is_of_pixels(std::string_view metric);

/// The pixels whose errors a metric counts, among those that the filter takes.
/// @return  Empty if the metric counts no errors, or contradicts the filter.
[[nodiscard]] std::optional<PixelFilter> counted_pixels(std::string_view metric,
                                                        const PixelFilter& filter);

/// Whether a metric of errors counts false lit pixels, or else false shadow; a metric of both sides
/// counts either.
[[nodiscard]] bool counts_side(std::string_view metric, bool is_false_lit);

/// Whether an error can match both metric and filter: acne, for one, is never false lit
/// (docs/causes.md). Metrics that also count right pixels take no cause or label.
[[nodiscard]] bool can_count(std::string_view metric, const PixelFilter& filter);

/// The metric over the pixels that the filter takes.
/// @param metric  One for which `is_of_pixels` is true.
/// @return  Empty if no cell matches, cells are unknown, or a rate's denominator is 0.
[[nodiscard]] std::optional<double> metric_of_pixels(const std::vector<ErrorBucket>& cells,
                                                     std::string_view metric,
                                                     const PixelFilter& filter);

} // namespace gnomon::analysis
