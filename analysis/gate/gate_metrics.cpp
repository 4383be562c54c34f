#include "analysis/gate/gate_metrics.hpp"

#include "analysis/results/metric_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

namespace gnomon::analysis {

namespace {

constexpr std::string_view curve_point_prefix = "bias_curve.at(";
/// The counts and rates at each point of a curve.
const std::vector<GateMetric>& curve_columns()
{
    static const std::vector<GateMetric> columns = [] {
        std::vector<GateMetric> all;
        for (const SubsetQuantity& quantity : subset_errors()) {
            all.push_back({quantity.name, true, Worse::up, quantity.type == MetricType::count});
        }
        for (const SubsetRate& rate : subset_rates()) {
            all.push_back({rate.name, false, Worse::up});
        }
        return all;
    }();
    return columns;
}

} // namespace

const std::vector<GateMetric>& result_metrics()
{
    static const std::vector<GateMetric> metrics = [] {
        std::vector<GateMetric> all;
        for (const MetricDescription& metric : metric_descriptions()) {
            if (metric.worse) {
                all.push_back({metric.name, metric.unit == "px", *metric.worse,
                               metric.type == MetricType::count});
            }
        }
        return all;
    }();
    return metrics;
}

const std::vector<GateMetric>& gate_metrics()
{
    static const std::vector<GateMetric> metrics = [] {
        std::vector<GateMetric> all = result_metrics();
        all.push_back({wrong_pixels_metric, true, Worse::up, true});
        all.push_back({error_amount_metric, true, Worse::up});
        all.push_back({scored_pixels_metric, true, Worse::down, true});
        all.push_back({new_pixels_metric, true, Worse::up, true});
        all.push_back({"map_error_m.min", false, Worse::down});
        all.push_back({"map_error_m.max", false, Worse::up});
        all.push_back({"map_error_m.largest", false, Worse::up});
        return all;
    }();
    return metrics;
}

const std::vector<std::string>& curve_point_columns()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const GateMetric& column : curve_columns()) {
            all.emplace_back(column.name);
        }
        return all;
    }();
    return names;
}

std::string CurvePointMetric::name() const
{
    return fmt::format("{}{}).{}", curve_point_prefix, bias, column);
}

std::optional<CurvePointMetric> curve_point_metric(std::string_view text)
{
    const std::size_t end = text.find(").");
    if (!text.starts_with(curve_point_prefix) || end == std::string_view::npos) {
        return std::nullopt;
    }
    const auto bias =
        number_in(text.substr(curve_point_prefix.size(), end - curve_point_prefix.size()));
    const std::string_view column = text.substr(end + 2);
    const bool is_column = std::ranges::any_of(
        curve_columns(), [&](const GateMetric& one) { return one.name == column; });
    return bias && is_column ? std::optional{CurvePointMetric{*bias, std::string{column}}}
                             : std::nullopt;
}

const GateMetric* find_gate_metric(std::string_view name)
{
    const auto has = [](std::string_view wanted) {
        return [wanted](const GateMetric& metric) { return metric.name == wanted; };
    };
    if (const auto point = curve_point_metric(name)) {
        return &*std::ranges::find_if(curve_columns(), has(point->column));
    }
    const auto& metrics = gate_metrics();
    const auto found = std::find_if(metrics.begin(), metrics.end(), has(name));
    return found == metrics.end() ? nullptr : &*found;
}

bool is_whole_metric(std::string_view name)
{
    const GateMetric* const metric = find_gate_metric(name);
    return metric != nullptr && metric->is_whole;
}

bool is_amount(std::string_view metric)
{
    const auto is_sum = [&](const ErrorSum& sum) { return sum.name == metric && !sum.is_count(); };
    const auto is_rate = [&](const SubsetRate& rate) {
        return rate.name == metric && is_amount(rate.errors.front());
    };
    return metric == error_amount_metric || metric.starts_with("shadow_amount") ||
           metric.starts_with("light_amount") || metric.starts_with("cause_amounts.") ||
           metric.starts_with("label_amounts.") || std::ranges::any_of(error_sums, is_sum) ||
           std::ranges::any_of(subset_rates(), is_rate);
}

bool is_gap_length(std::string_view name)
{
    return name.starts_with("peter_panning_gap_") && name != gap_pixels_metric;
}

std::optional<double> number_in(std::string_view text)
{
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool is_number = error == std::errc{} && stop == end && std::isfinite(value);
    return is_number ? std::optional{value} : std::nullopt;
}

} // namespace gnomon::analysis
