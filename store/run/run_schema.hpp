#pragma once

#include "store/run/schema_version.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// The database of a run, in its folder.
[[nodiscard]] std::filesystem::path results_path(const std::filesystem::path& folder);

/// What the view `error_vs_z` selects, the columns of the CSV file and FROM `curve_bins b`: between
/// SELECT and a WHERE.
[[nodiscard]] std::string error_vs_z_columns();

/// Whether the database has errors by map, `map_errors`: an older one may not. A configuration of a
/// light with one map has none there.
/// @param schema  "main", or that of an attached database.
[[nodiscard]] bool has_map_errors(const sqlite::Database& database,
                                  const std::string& schema = "main");

/// @throws scene::InputError  if it is not a run's database, or one of another schema.
void require_run_schema(const sqlite::Database& database);

/// Which schema a run's database has, and what of this Gnomon's numbers that lacks.
struct RunSchema {
    std::int64_t version = run_schema;
    std::vector<std::string> lacks; ///< columns of `results` and `bias_curves`, empty in every row
};

/// Readies a database for reading alone. One of schema 1 is shown, to this connection, as one of
/// the present schema: what it lacks is NULL, and what was then called `acne_free` is
/// `acne_free_count`, and `acne_free` too where a verdict is no mean of taps.
/// @throws scene::InputError  if it is not a run's database, or one of any other schema.
RunSchema prepare_reading(const sqlite::Database& database);

/// "this run is of schema 1: …": what is to be said of a run of an older schema; empty for the
/// present one.
[[nodiscard]] std::string schema_text(const RunSchema& schema);

/// Gives the view `results` the columns that the run's lights ask for (`light_columns`): to be
/// called within the transaction that writes the run's description.
void show_light_columns(const sqlite::Database& database);

/// Readies a database for writing, whether it is new, whole or left by a process that was killed;
/// a new one gets its tables and views (docs/runs.md).
/// @throws scene::InputError  as `require_run_schema` does, and if the database is damaged.
void prepare_run(sqlite::Database& database);

} // namespace gnomon::store
