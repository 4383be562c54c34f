#pragma once

#include "analysis/metric_table.hpp"
#include "reports/json_values.hpp"

#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::reports {

/// The member that a metric's name leads to, made on the way: parts between dots are members,
/// numbers and the two ends `lo` and `hi` of an interval places in an array.
[[nodiscard]] Json& member_at(Json& json, std::string_view name);

/// Sets the members that the metrics are named after; null for what does not exist.
template <typename Source>
void add_metrics(Json& json, const std::vector<analysis::Metric<Source>>& metrics,
                 const Source& source)
{
    for (const analysis::Metric<Source>& metric : metrics) {
        member_at(json, metric.name) = std::visit(
            [](const auto& value) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
                    return Json(nullptr);
                } else {
                    return Json(value);
                }
            },
            metric.value(source));
    }
}

} // namespace gnomon::reports
