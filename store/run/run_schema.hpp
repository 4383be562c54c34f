#pragma once

#include "store/run/run_types.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// The path of a run's database.
[[nodiscard]] std::filesystem::path results_path(const std::filesystem::path& folder);

/// The columns of error_vs_z.csv, then FROM `curve_bins b`: goes between SELECT and WHERE.
[[nodiscard]] std::string error_vs_z_columns();

/// Whether the database has the table `map_errors`, which older runs lack. It holds only
/// configurations of lights with several maps.
/// @param schema  "main", or the name of an attached database.
[[nodiscard]] bool has_map_errors(const sqlite::Database& database,
                                  const std::string& schema = "main");

/// @throws scene::InputError  if this is not a run's database, or has another schema.
void require_run_schema(const sqlite::Database& database);

/// The schema of a run's database, and the present columns that it lacks.
struct RunSchema {
    std::int64_t version = run_schema;
    std::vector<std::string>
        lacks; ///< columns of `results` and `bias_curves` that are NULL everywhere
};

/// Prepares a database for reading. This connection sees schema 1 as the present schema: missing
/// columns are NULL, and the old `acne_free` is `acne_free_count`. It is also `acne_free` if the
/// filter has one tap.
/// @throws scene::InputError  if this is not a run's database, or has another schema.
RunSchema prepare_reading(const sqlite::Database& database);

/// A sentence about a run of an older schema: "this run is of schema 1: …"; empty for the present
/// one.
[[nodiscard]] std::string schema_text(const RunSchema& schema);

/// Gives the view `results` the run's `light_columns`. Call it within the transaction that writes
/// the run's description.
void show_light_columns(const sqlite::Database& database);

/// Prepares a database for writing, even after its writer was killed. A new one gets its tables and
/// views (docs/runs.md).
/// @throws scene::InputError  as `require_run_schema` does; also if the database is damaged.
void prepare_run(sqlite::Database& database);

} // namespace gnomon::store
