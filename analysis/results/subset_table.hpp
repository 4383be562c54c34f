#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/results/metric_table.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace gnomon::analysis {

/// A number that is counted or added up in every subset of the scored pixels: in bins, objects,
/// cells, points of the bias curve, and in all of the image.
struct SubsetQuantity {
    std::string_view name;
    MetricType type; ///< `count` or `number`
    MetricValue (*value)(const SubsetCounts&);

    [[nodiscard]] double number(const SubsetCounts& subset) const;
};

/// `lit` and `blocked`, then what is wrong of them.
[[nodiscard]] std::span<const SubsetQuantity> subset_quantities();
/// Those behind `lit` and `blocked`.
[[nodiscard]] std::span<const SubsetQuantity> subset_errors();

/// A quotient of quantities: both sides are sums.
struct SubsetRate {
    std::string_view name;
    std::span<const std::string_view> errors; ///< of `subset_quantities`
    std::span<const std::string_view> pixels; ///< of the same, mostly `lit`, `blocked`, or both
    std::string_view meaning;                 ///< this and the rest: as in `MetricDescription`
    std::string_view title;
    bool is_outcome = false;
    std::string_view table_note = {};
};

/// Everything that is called a rate, and `mean_abs_error`: each a metric of a configuration, too.
[[nodiscard]] std::span<const SubsetRate> subset_rates();
/// The rate in one subset; empty where that has no such pixels.
[[nodiscard]] std::optional<double> rate_of(const SubsetRate& rate, const SubsetCounts& counts);

} // namespace gnomon::analysis
