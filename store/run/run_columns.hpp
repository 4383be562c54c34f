#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/results/results.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// A column whose value comes from a `Source`.
template <typename Source>
struct RunColumn {
    std::string name;      ///< in the database and in the CSV file
    std::string_view type; ///< SQLite's: INTEGER, REAL or TEXT
    std::function<sqlite::Value(const Source&)> value;

    [[nodiscard]] bool is_integer() const { return type == "INTEGER"; }
};

/// A column that holds a job key.
struct JobColumn {
    std::string name; ///< the key
    std::string_view type;
};

/// The columns of a run's tables, in the order of the CSV files (docs/csv_schema.md). Their names
/// are the paths of `gnomon compare --json`, joined with dots; null becomes NULL.
[[nodiscard]] const std::vector<JobColumn>& job_columns();
/// Whether configurations of one curve may differ in the key. They do in the constant bias, and in
/// the path of the scene file if copies of it are used.
[[nodiscard]] bool is_configuration_key(std::string_view key);
/// The columns of keys for which `is_configuration_key` holds.
[[nodiscard]] const std::vector<JobColumn>& configuration_key_columns();
/// The columns of all other keys: a curve's configurations share them.
[[nodiscard]] const std::vector<JobColumn>& curve_key_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::CurveResult>>& map_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::ConfigurationResult>>& result_columns();
/// Columns of the database that no CSV file has.
[[nodiscard]] const std::vector<RunColumn<analysis::ConfigurationResult>>& error_bucket_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::CurveResult>>& bias_curve_columns();
/// Columns for one of a light's several maps: its range, and the errors of the pixels that read it.
[[nodiscard]] const std::vector<RunColumn<analysis::MapResult>>& map_error_columns();
/// Points of bias curves, and bins of light distance.
[[nodiscard]] const std::vector<RunColumn<analysis::CurveSample>>& point_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::ErrorBin>>& bin_columns();

/// A job's value as a cell: numbers as numbers, strings without quotes, anything else unchanged.
/// @param toml  as `scene::resolved_keys` writes it.
[[nodiscard]] sqlite::Value job_cell(const std::string& toml);

/// A column of the view `results` and of results.csv.
struct ResultsColumn {
    /// Which configurations share the value.
    enum class Of : std::uint8_t {
        configuration,
        curve, ///< all configurations of a curve that have the same status
    };

    std::string name;
    std::string expression; ///< over `results_tables()`
    Of of;
};
/// @param light_columns  for runs with several lights (`light_columns`).
[[nodiscard]] std::vector<ResultsColumn>
results_columns(const std::vector<std::string>& light_columns = {});
/// The axes that are not keys of every job with one light, sorted: the light itself, keys of one
/// light
/// ("lights.sun.bias.slope"), and engine keys ("engine.bias").
[[nodiscard]] std::vector<std::string> light_columns(const std::vector<std::string>& axes);
/// As above for the run in the database, with all of its engine keys.
[[nodiscard]] std::vector<std::string> light_columns(const sqlite::Database& database);
/// The tables behind `results_columns`: `part` p, `configurations` c, and the configuration's curve
/// k. The curve is also v, if the configuration is done.
[[nodiscard]] std::string results_tables();

} // namespace gnomon::store
