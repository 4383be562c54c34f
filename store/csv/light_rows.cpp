#include "store/csv/light_rows.hpp"

#include "analysis/results/metric_table.hpp"
#include "analysis/results/subset_table.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

namespace gnomon::store {

namespace {

using sqlite::Value;

constexpr std::string_view done = "done";

/// Whose value is of one light alone, though all lights may happen to share it.
bool is_of_one_light(std::string_view column)
{
    return column == "id" || column == "curve" || column == scene::light_distinction;
}

const analysis::MetricDescription* find_metric(std::string_view column)
{
    const auto& all = analysis::metric_descriptions();
    const auto found = std::ranges::find(all, column, &analysis::MetricDescription::name);
    return found == all.end() ? nullptr : &*found;
}

/// Empty where a light has no such number.
Value sum_of(std::span<const ResultRow> lights, const analysis::MetricDescription& metric)
{
    double sum = 0;
    for (const ResultRow& light : lights) {
        const std::optional<double> number = light.number(metric.name);
        if (!number) {
            return {};
        }
        sum += *number; // counts of pixels are exact in a double
    }
    return metric.type == analysis::MetricType::count ? Value{static_cast<std::int64_t>(sum)}
                                                      : Value{sum};
}

/// All lights' scored pixels, and what is wrong of them.
analysis::SubsetCounts counts_of(std::span<const ResultRow> lights)
{
    analysis::SubsetCounts sum;
    for (const ResultRow& light : lights) {
        sum.lit += light.count("pixels.lit");
        sum.blocked += light.count("pixels.blocked");
        sum.false_shadow += light.count("false_shadow");
        sum.false_lit += light.count("false_lit");
        sum.shadow_amount += light.number("shadow_amount").value_or(0);
        sum.light_amount += light.number("light_amount").value_or(0);
    }
    return sum;
}

/// Numbers of a bias curve are of one light's biases.
bool is_of_curve(const analysis::MetricDescription& metric)
{
    const auto& all = analysis::curve_metrics();
    return std::ranges::find(all, metric.name, &analysis::MetricDescription::name) != all.end();
}

Value measured(std::span<const ResultRow> lights, const analysis::MetricDescription& metric)
{
    if (is_of_curve(metric)) {
        return {};
    }
    if (metric.adds_up()) {
        return sum_of(lights, metric);
    }
    const auto rates = analysis::subset_rates();
    const auto rate = std::ranges::find(rates, metric.name, &analysis::SubsetRate::name);
    if (rate == rates.end()) {
        return {};
    }
    const auto value = analysis::rate_of(*rate, counts_of(lights));
    return value ? Value{*value} : Value{};
}

Value common(std::span<const ResultRow> lights, std::size_t column)
{
    const Value& first = lights.front().cells()[column].second;
    const bool is_common = std::ranges::all_of(
        lights, [&](const ResultRow& light) { return light.cells()[column].second == first; });
    return is_common ? first : Value{};
}

/// The worst of the lights' states.
std::string state_of(std::span<const ResultRow> lights, std::size_t light_count)
{
    constexpr std::string_view failed = "failed";
    const auto count = [&](std::string_view state) {
        return static_cast<std::size_t>(std::ranges::count_if(
            lights, [&](const ResultRow& light) { return light.text("status") == state; }));
    };
    if (count(failed) > 0) {
        return std::string{failed};
    }
    return std::string{count(done) == light_count ? done : "planned"};
}

/// The first light's that failed.
Value message_of(std::span<const ResultRow> lights)
{
    for (const ResultRow& light : lights) {
        if (const std::string message = light.text("message"); !message.empty()) {
            return fmt::format("light {}: {}", light.text(scene::light_distinction), message);
        }
    }
    return {};
}

} // namespace

std::vector<Value> total_row(std::span<const ResultRow> lights, std::size_t light_count)
{
    const std::string state = state_of(lights, light_count);
    std::vector<Value> total;
    const auto& cells = lights.front().cells();
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string& column = cells[i].first;
        if (column == "status") {
            total.emplace_back(state);
        } else if (column == "message") {
            total.push_back(message_of(lights));
        } else if (const auto* metric = find_metric(column)) {
            total.push_back(state == done ? measured(lights, *metric) : Value{});
        } else {
            total.push_back(is_of_one_light(column) ? Value{} : common(lights, i));
        }
    }
    return total;
}

} // namespace gnomon::store
