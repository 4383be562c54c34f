#include "reports/page/run_overview.hpp"

#include "methods/key_table.hpp"
#include "reports/text/text.hpp"
#include "scene/job/keys/written_key.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/csv/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace gnomon::reports {

namespace {

constexpr const char* where_measured = "WHERE status = 'done' AND error_rate IS NOT NULL";

/// A cell for people: whole numbers and texts as they are, other numbers to four digits.
std::string short_text(const store::sqlite::ValueView& cell)
{
    const auto* const real = std::get_if<double>(&cell);
    return real == nullptr || *real == std::floor(*real) ? store::cell_text(cell)
                                                         : fmt::format("{:.4g}", *real);
}
std::string short_text(const store::ResultRow& row, const std::string& column)
{
    const std::optional<double> number = row.number(column);
    return number ? short_text(*number) : row.text(column);
}

/// Configurations with the same errors that differ only in biases.
struct Tie {
    std::uint64_t ordinal = 0; ///< of the first configuration
    std::uint64_t count = 1;
    std::map<std::string, std::string> ranges = {}; ///< by bias axis: "0.01 to 0.03"
    std::string mean_error = {};                    ///< empty: the first configuration's
};

/// Whether the axis applies to the row's light; an axis of one light applies to no other.
bool concerns(const std::string& axis, const store::ResultRow& row)
{
    const std::string light = scene::find_written_key(*methods::key_table(), axis).light;
    return light.empty() || light == row.text(scene::light_distinction);
}

/// The case, then "shadow_map.resolution = 2048, bias.constant = 0".
std::string settings_text(const store::RunDescription& description, const store::ResultRow& row,
                          const Tie& tie)
{
    std::string text;
    const auto add = [&](const std::string& name) {
        const auto range = tie.ranges.find(name);
        const std::string value = range == tie.ranges.end() ? short_text(row, name) : range->second;
        if (!value.empty()) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
        }
    };
    add("case");
    for (const std::string& axis : description.axes) {
        if (concerns(axis, row)) {
            add(axis);
        }
    }
    return tie.count == 1 ? text
                          : fmt::format("{} ({})", text, counted(tie.count, "configuration"));
}

std::uint64_t row_index(const store::RunReader& run, std::uint64_t ordinal)
{
    return static_cast<std::uint64_t>(run.database().integer(
        fmt::format("SELECT count(*) FROM part WHERE ordinal < {}", ordinal)));
}

OverviewRow tied_row(const store::RunReader& run, store::ResultRow row, const Tie& tie)
{
    const std::uint64_t index = row_index(run, row.count("ordinal"));
    std::string settings = settings_text(run.description(), row, tie);
    std::string mean_error =
        tie.mean_error.empty() ? percent(row.number("mean_abs_error")) : tie.mean_error;
    return {index, std::move(settings), std::move(mean_error), std::move(row)};
}

std::vector<std::string> bias_axes(const store::RunDescription& description)
{
    std::vector<std::string> axes;
    std::ranges::copy_if(description.axes, std::back_inserter(axes),
                         [](const std::string& axis) { return axis.starts_with("bias."); });
    return axes;
}

/// SQL for ties: the first ordinal, the count, and the range of the mean error and of each bias.
/// With several lights, only rows of the same job are tied.
/// @param condition  "AND …", which rows; empty: all.
std::string tie_query(const store::RunDescription& description, std::string_view condition,
                      std::string_view order, std::size_t most)
{
    std::string ranges = ", min(mean_abs_error), max(mean_abs_error)";
    for (const std::string& axis : bias_axes(description)) {
        ranges += fmt::format(", min({0}), max({0})", store::sqlite::sql_name(axis));
    }
    std::string same = "error_rate, false_shadow, false_lit, map_bytes, \"case\"";
    for (const std::string& axis : description.axes) {
        same += axis.starts_with("bias.") ? std::string{} : ", " + store::sqlite::sql_name(axis);
    }
    if (!description.lights.empty()) { // axes of other lights do not matter
        same = fmt::format("error_rate, \"case\", {}, id",
                           store::sqlite::sql_name(scene::light_distinction));
    }
    return fmt::format("SELECT min(ordinal), {}{} FROM results {} {} GROUP BY {} ORDER BY {}"
                       " LIMIT {}",
                       description.lights.empty() ? "count(*)" : "1", ranges, where_measured,
                       condition, same, order, most);
}

std::string range_text(const std::string& low, const std::string& high)
{
    return low == high ? low : fmt::format("{} to {}", low, high);
}

std::optional<double> number_at(const store::sqlite::Statement& find, int column)
{
    const store::sqlite::ValueView cell = find.value(column);
    const auto* const real = std::get_if<double>(&cell);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

std::vector<Tie> find_ties(const store::RunReader& run, std::string_view order, std::size_t most,
                           std::string_view condition = {})
{
    const std::vector<std::string> axes = bias_axes(run.description());
    store::sqlite::Statement find{run.database(),
                                  tie_query(run.description(), condition, order, most)};
    std::vector<Tie> ties;
    while (find.step()) {
        Tie tie{static_cast<std::uint64_t>(find.integer(0)),
                static_cast<std::uint64_t>(find.integer(1))};
        tie.mean_error = range_text(percent(number_at(find, 2)), percent(number_at(find, 3)));
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const auto at = static_cast<int>(4 + 2 * i);
            tie.ranges[axes[i]] =
                range_text(short_text(find.value(at)), short_text(find.value(at + 1)));
        }
        ties.push_back(std::move(tie));
    }
    return ties;
}

constexpr std::string_view best_first = "error_rate, map_bytes, min(ordinal)";
constexpr std::string_view worst_first = "error_rate DESC, min(ordinal) DESC";

OverviewRow row_of(const store::RunReader& run, const Tie& tie)
{
    return tied_row(
        run, std::move(run.rows(fmt::format("WHERE ordinal = {}", tie.ordinal)).front()), tie);
}

/// A text as an SQL literal.
std::string sql_text(std::string_view text)
{
    std::string literal = "'";
    for (const char c : text) {
        literal += c == '\'' ? "''" : std::string(1, c);
    }
    return literal + '\'';
}

} // namespace

OverviewRow named_row(const store::RunReader& run, store::ResultRow row)
{
    return tied_row(run, std::move(row), {});
}

std::vector<std::string> measured_cases(const store::RunReader& run)
{
    store::sqlite::Statement find{
        run.database(),
        fmt::format("SELECT \"case\" FROM results {} AND \"case\" IS NOT NULL GROUP BY \"case\""
                    " ORDER BY min(ordinal)",
                    where_measured)};
    std::vector<std::string> cases;
    while (find.step()) {
        cases.push_back(find.text(0));
    }
    return cases;
}

std::string of_case(const std::string& name)
{
    return fmt::format("AND \"case\" = {}", sql_text(name));
}
std::string of_light(const std::string& name)
{
    return fmt::format("AND {} = {}", store::sqlite::sql_name(scene::light_distinction),
                       sql_text(name));
}

std::vector<std::string> comparable_groups(const store::RunReader& run)
{
    std::vector<std::string> cases;
    std::ranges::transform(measured_cases(run), std::back_inserter(cases), of_case);
    if (cases.empty()) {
        cases.emplace_back();
    }
    const std::vector<std::string>& lights = run.description().lights;
    if (lights.empty()) {
        return cases;
    }
    std::vector<std::string> groups;
    for (const std::string& condition : cases) {
        for (const std::string& light : lights) {
            groups.push_back(condition + " " + of_light(light));
        }
    }
    return groups;
}

std::vector<OverviewRow> ranked_rows(const store::RunReader& run)
{
    std::vector<Tie> ties = find_ties(run, best_first, most_rows_shown);
    if (ties.size() == most_rows_shown) {
        ties.back() = find_ties(run, worst_first, 1).front();
    }
    std::vector<OverviewRow> rows;
    for (const Tie& tie : ties) {
        rows.push_back(row_of(run, tie));
    }
    return rows;
}

std::vector<OverviewRow> best_and_worst(const store::RunReader& run, std::string_view condition)
{
    const auto best = find_ties(run, best_first, 2, condition);
    std::vector<OverviewRow> ends;
    if (!best.empty()) {
        ends.push_back(row_of(run, best.front()));
    }
    if (best.size() > 1) {
        ends.push_back(row_of(run, find_ties(run, worst_first, 1, condition).front()));
    }
    return ends;
}

} // namespace gnomon::reports
