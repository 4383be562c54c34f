#pragma once

#include "analysis/results/metric_table.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// Building blocks for the lists of metrics.
namespace gnomon::analysis::metric_parts {

inline constexpr MetricValue none{};

[[nodiscard]] inline MetricValue number(const std::optional<double>& value)
{
    return value ? MetricValue{*value} : none;
}
/// The value, or none if it is infinite, as a limit that does not exist.
[[nodiscard]] inline MetricValue finite(float value)
{
    return std::isfinite(value) ? MetricValue{double{value}} : none;
}

/// A count of pixels; more are worse by default.
[[nodiscard]] inline MetricDescription pixel_count(std::string name, std::string meaning,
                                                   Worse worse = Worse::up)
{
    return {std::move(name), MetricType::count, "px", std::move(meaning), worse};
}
/// A number; more is worse by default.
[[nodiscard]] inline MetricDescription measured(std::string name, std::string_view unit,
                                                std::string meaning, Worse worse = Worse::up)
{
    return {std::move(name), MetricType::number, unit, std::move(meaning), worse};
}
[[nodiscard]] inline MetricDescription titled(MetricDescription metric, std::string_view title)
{
    metric.title = title;
    return metric;
}
[[nodiscard]] inline MetricDescription outcome(MetricDescription metric, std::string_view title)
{
    metric.is_outcome = true;
    return titled(std::move(metric), title);
}

} // namespace gnomon::analysis::metric_parts
