#pragma once

#include "analysis/results/metric_table.hpp"
#include "store/json_values.hpp"

#include <string_view>
#include <vector>

namespace gnomon::reports {

/// The member that a metric's name leads to, made on the way: parts between dots are members,
/// numbers and the two ends `lo` and `hi` of an interval places in an array.
[[nodiscard]] store::Json& member_at(store::Json& json, std::string_view name);

/// Null where there is none.
[[nodiscard]] store::Json value_json(const analysis::MetricValue& value);

/// Sets the members that the metrics are named after; null for what does not exist.
template <typename Source>
void add_metrics(store::Json& json, const std::vector<analysis::Metric<Source>>& metrics,
                 const Source& source)
{
    for (const analysis::Metric<Source>& metric : metrics) {
        member_at(json, metric.name) = value_json(metric.value(source));
    }
}

} // namespace gnomon::reports
