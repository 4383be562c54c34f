#include "store/baseline/gate_run.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/baseline/kept_wrong_pixels.hpp"
#include "store/json_values.hpp"
#include "store/run/error_buckets_json.hpp"
#include "store/run/run_columns.hpp"
#include "store/run/run_commands.hpp"
#include "store/run/run_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::store {

namespace {

analysis::GateEntry entry_of(const ResultRow& row, const std::vector<std::string>& axes)
{
    analysis::GateEntry entry;
    entry.key.case_name = row.text("case");
    for (const std::string& axis : axes) {
        entry.key.axes[axis] = row.text(axis);
    }
    for (auto& [key, value] : job_settings(row)) {
        if (!entry.key.axes.contains(key)) {
            entry.parameters.emplace(std::move(key), std::move(value));
        }
    }
    if (std::string hash = row.text("scene_hash"); !hash.empty()) {
        entry.parameters.emplace("scene_hash", std::move(hash));
    }
    for (const analysis::GateMetric& metric : analysis::result_metrics()) {
        if (const auto value = row.number(metric.name); value && std::isfinite(*value)) {
            entry.metrics.emplace(metric.name, *value);
        }
    }
    return entry;
}

double number_of(const sqlite::ValueView& value)
{
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*integer);
    }
    const auto* const real = std::get_if<double>(&value);
    return real == nullptr ? 0 : *real;
}

/// Completes configurations from tables other than `results`.
class EntryCompleter {
public:
    EntryCompleter(const RunReader& run, const std::vector<analysis::CurvePointMetric>& points)
        : points_{&points},
          find_cells_{run.database(), "SELECT errors_by_part FROM configurations WHERE id = ?"},
          find_errors_{run.database(), "SELECT min(\"map_error_m.min\"), max(\"map_error_m.max\")"
                                       " FROM error_vs_z WHERE curve = ?"},
          find_point_{run.database(),
                      fmt::format("SELECT {} FROM bias_curves WHERE curve = ?1 ORDER BY bias > ?2,"
                                  " CASE WHEN bias > ?2 THEN bias ELSE -bias END LIMIT 1",
                                  fmt::join(analysis::curve_point_columns(), ", "))}
    {
    }

    void complete(analysis::GateEntry& entry, const ResultRow& row)
    {
        add_cells(entry, row.text("id"));
        const std::string curve = row.text("curve");
        auto& known = metrics_[curve];
        if (known.empty()) {
            add_errors(known, curve);
            add_points(known, curve);
        }
        entry.metrics.insert(known.begin(), known.end());
    }

private:
    void add_cells(analysis::GateEntry& entry, const std::string& id)
    {
        find_cells_.bind(1, std::string_view{id});
        if (find_cells_.step() && !find_cells_.is_null(0)) {
            const std::string place = fmt::format("errors_by_part of {}", id);
            entry.cells =
                error_buckets_from_json(Json::parse(find_cells_.text(0), nullptr, false), place);
        }
        find_cells_.reset();
    }

    void add_errors(std::map<std::string, double>& metrics, const std::string& curve)
    {
        find_errors_.bind(1, std::string_view{curve});
        if (find_errors_.step() && !find_errors_.is_null(0)) {
            const double min = number_of(find_errors_.value(0));
            const double max = number_of(find_errors_.value(1));
            metrics["map_error_m.min"] = min;
            metrics["map_error_m.max"] = max;
            metrics["map_error_m.largest"] = std::max(std::abs(min), std::abs(max));
        }
        find_errors_.reset();
    }

    void add_points(std::map<std::string, double>& metrics, const std::string& curve)
    {
        const auto& columns = analysis::curve_point_columns();
        for (const analysis::CurvePointMetric& point : *points_) {
            const auto column = std::find(columns.begin(), columns.end(), point.column);
            const auto index = static_cast<int>(column - columns.begin());
            // The lookup uses a float32 bias.
            find_point_.bind(1, std::string_view{curve})
                .bind(2, double{static_cast<float>(point.bias)});
            if (find_point_.step() && !find_point_.is_null(index)) {
                metrics[point.name()] = number_of(find_point_.value(index));
            }
            find_point_.reset();
        }
    }

    const std::vector<analysis::CurvePointMetric>* points_;
    sqlite::Statement find_cells_;
    sqlite::Statement find_errors_;
    sqlite::Statement find_point_;
    std::map<std::string, std::map<std::string, double>> metrics_; ///< by curve
};

} // namespace

std::vector<analysis::CurvePointMetric>
curve_points_of(const std::vector<analysis::GateRule>& rules)
{
    std::vector<analysis::CurvePointMetric> points;
    for (const analysis::GateRule& rule : rules) {
        if (auto point = analysis::curve_point_metric(rule.metric)) {
            points.push_back(std::move(*point));
        }
    }
    return points;
}

GateRun read_gate_run(const std::filesystem::path& folder,
                      const std::vector<analysis::CurvePointMetric>& points)
{
    GateRun run;
    run.folder = folder;
    run.status = read_run_status(folder, 0);
    const RunReader reader{folder};
    run.results.environment = reader.description().environment;
    run.results.axes = reader.description().axes;
    EntryCompleter completer{reader, points};
    for (const ResultRow& row : reader.rows("WHERE status = 'done' ORDER BY ordinal")) {
        analysis::GateEntry entry = entry_of(row, run.results.axes);
        completer.complete(entry, row);
        if (const std::string id = row.text("id"); has_kept_pixels(folder, id)) {
            entry.pixels = id;
        }
        run.results.entries.push_back(std::move(entry));
    }
    run.has_several_environments =
        reader.database().integer("SELECT count(DISTINCT c.environment) FROM part p"
                                  " JOIN configurations c ON c.number = p.configuration"
                                  " WHERE c.status = 'done'") > 1;
    if (const auto twins = sort_entries(run.results)) {
        throw scene::InputError(fmt::format(
            "{}: two configurations are {}: give the axes values that differ",
            scene::one_line(folder.string()), key_text(run.results.entries[twins->first].key)));
    }
    return run;
}

std::string showing_command(const GateRun& run, const analysis::ConfigurationKey& key)
{
    return compare_command(run.status.description, key.case_name,
                           {key.axes.begin(), key.axes.end()});
}

std::string key_text(const analysis::ConfigurationKey& key)
{
    std::string text = key.case_name;
    for (const auto& [axis, value] : key.axes) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", axis, value);
    }
    return text.empty() ? "the only configuration" : scene::one_line(text);
}

Json key_json(const analysis::ConfigurationKey& key)
{
    Json axes = Json::object();
    for (const auto& [axis, value] : key.axes) {
        axes[axis] = value;
    }
    return {{"case", key.case_name}, {"axes", std::move(axes)}};
}

Json metric_json(std::string_view metric, const std::optional<double>& value)
{
    if (value && analysis::is_whole_metric(metric)) {
        return Json(static_cast<std::uint64_t>(*value));
    }
    return number_or_null(value);
}

} // namespace gnomon::store
