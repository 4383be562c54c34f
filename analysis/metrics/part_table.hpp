#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/metric_table.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace gnomon::analysis {

/// A number that is counted or added up in every part of the scored pixels: in bins, objects,
/// points of the bias curve, and in all of the image.
struct PartQuantity {
    std::string_view name;
    MetricType type; ///< `count` or `number`
    MetricValue (*value)(const PartCounts&);

    [[nodiscard]] double number(const PartCounts& counts_of_part) const;
};

/// `lit` and `blocked`, then what is wrong of them.
[[nodiscard]] std::span<const PartQuantity> part_quantities();
/// Those behind `lit` and `blocked`.
[[nodiscard]] std::span<const PartQuantity> part_errors();

/// A quotient of quantities: both sides are sums.
struct PartRate {
    std::string_view name;
    std::span<const std::string_view> errors; ///< of `part_errors`
    std::span<const std::string_view> pixels; ///< `lit`, `blocked`, or both
};

/// Everything that is called a rate, and `mean_abs_error`.
[[nodiscard]] std::span<const PartRate> part_rates();
/// Empty where there are no such pixels.
[[nodiscard]] std::optional<double> rate_of(const PartRate& rate, const PartCounts& counts);

} // namespace gnomon::analysis
