#pragma once

#include "reports/run/sqlite.hpp"

#include <filesystem>
#include <string>

namespace gnomon::reports {

/// Of the database's tables and of the CSV files' columns.
inline constexpr int run_schema = 1;

/// The database of a run, in its folder.
[[nodiscard]] std::filesystem::path results_path(const std::filesystem::path& folder);

/// Makes the tables and views of an empty database (docs/runs.md), as part of a transaction.
void create_run_schema(const sqlite::Database& database);

/// @throws scene::InputError  if it is not a run's database, or one of another schema.
void require_run_schema(const sqlite::Database& database);

} // namespace gnomon::reports
