#pragma once

#include "reports/run/sqlite.hpp"

#include <filesystem>
#include <string>

namespace gnomon::reports {

/// Of the database's tables and of the CSV files' columns.
inline constexpr int run_schema = 1;

/// The database of a run, in its folder.
[[nodiscard]] std::filesystem::path results_path(const std::filesystem::path& folder);

/// What the view `error_vs_z` selects, the columns of the CSV file and FROM `curve_bins b`: between
/// SELECT and a WHERE.
[[nodiscard]] std::string error_vs_z_columns();

/// @throws scene::InputError  if it is not a run's database, or one of another schema.
void require_run_schema(const sqlite::Database& database);

/// Readies a database for writing, whether it is new, whole or left by a process that was killed;
/// a new one gets its tables and views (docs/runs.md).
/// @throws scene::InputError  as `require_run_schema` does, and if the database is damaged.
void prepare_run(sqlite::Database& database);

} // namespace gnomon::reports
