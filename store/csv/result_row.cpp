#include "store/csv/result_row.hpp"

#include "analysis/results/metric_table.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>

namespace gnomon::store {

namespace {

using sqlite::Value;

Value owned(const sqlite::ValueView& value)
{
    if (const auto* text = std::get_if<std::string_view>(&value)) {
        return std::string{*text};
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return *integer;
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return *real;
    }
    return {};
}

constexpr std::string_view done = "done";

/// Whether a column's value belongs to one light, even if all lights happen to share it.
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

/// Empty if a light lacks the number.
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

/// Scored and wrong pixels of all lights.
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

/// Whether a metric belongs to a bias curve, and so to one light.
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

/// The message of the first light that failed.
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

ResultRow::ResultRow(const sqlite::Statement& statement)
{
    for (int i = 0; i < statement.column_count(); ++i) {
        cells_.emplace_back(statement.column_name(i), owned(statement.value(i)));
    }
}

const Value* ResultRow::find(std::string_view column) const
{
    const auto cell = std::find_if(cells_.begin(), cells_.end(),
                                   [&](const auto& named) { return named.first == column; });
    return cell == cells_.end() ? nullptr : &cell->second;
}

std::optional<double> ResultRow::number(std::string_view column) const
{
    const Value* const value = find(column);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (const auto* integer = std::get_if<std::int64_t>(value)) {
        return static_cast<double>(*integer);
    }
    const auto* const real = std::get_if<double>(value);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

std::uint64_t ResultRow::count(std::string_view column) const
{
    const Value* const value = find(column);
    const auto* const integer = value == nullptr ? nullptr : std::get_if<std::int64_t>(value);
    return integer == nullptr ? 0 : static_cast<std::uint64_t>(*integer);
}

std::string ResultRow::text(std::string_view column) const
{
    const Value* const value = find(column);
    if (value == nullptr) {
        return {};
    }
    if (const auto* words = std::get_if<std::string>(value)) {
        return *words;
    }
    if (const auto* real = std::get_if<double>(value)) {
        return cell_text(*real);
    }
    const auto* const integer = std::get_if<std::int64_t>(value);
    return integer == nullptr ? std::string{} : cell_text(*integer);
}

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
