#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "analysis/results/results.hpp"
#include "store/sqlite.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// A column that holds something of a `Source`.
template <typename Source>
struct RunColumn {
    std::string name;      ///< in the database and in the CSV file
    std::string_view type; ///< of SQLite
    std::function<sqlite::Value(const Source&)> value;

    [[nodiscard]] bool is_integer() const { return type == "INTEGER"; }
};

/// A job's key as a column.
struct JobColumn {
    std::string name; ///< the key
    std::string_view type;
};

/// The columns of a run's tables, in the order of the CSV files (docs/csv_schema.md). Names are the
/// paths of `gnomon compare --json`, joined with dots; a value that is null there is NULL.
[[nodiscard]] const std::vector<JobColumn>& job_columns();
/// Whether configurations of a curve may differ in the key: constant biases do, and files of equal
/// content may stand in several places.
[[nodiscard]] bool is_configuration_key(std::string_view key);
/// The columns of such keys.
[[nodiscard]] const std::vector<JobColumn>& configuration_key_columns();
/// The others, which a curve has.
[[nodiscard]] const std::vector<JobColumn>& curve_key_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::CurveResult>>& map_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::ConfigurationResult>>& result_columns();
/// Of the database alone: no CSV file has them.
[[nodiscard]] const std::vector<RunColumn<analysis::ConfigurationResult>>& cell_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::CurveResult>>& bias_curve_columns();
/// Of one of a light's several maps: what it sees, and the errors of the pixels that read it.
[[nodiscard]] const std::vector<RunColumn<analysis::MapResult>>& map_error_columns();
/// Points of bias curves, and bins of light distance.
[[nodiscard]] const std::vector<RunColumn<analysis::CurveSample>>& point_columns();
[[nodiscard]] const std::vector<RunColumn<analysis::ErrorBin>>& bin_columns();

/// A job's value as a cell: numbers as numbers, texts without their quotes, the rest as it stands.
/// @param toml  as `scene::resolved_keys` writes it.
[[nodiscard]] sqlite::Value job_cell(const std::string& toml);

} // namespace gnomon::store
