#pragma once

#include "store/sqlite.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// The files of `write_run_csv`; the last only if a finished configuration has several maps.
inline constexpr std::array<std::string_view, 4> run_csv_names{"results.csv", "error_vs_z.csv",
                                                               "bias_curves.csv", "by_map.csv"};

/// Implements `RunStore::write_csv`. All files show one snapshot of the database.
void write_run_csv(const sqlite::Database& database, const std::filesystem::path& folder);

} // namespace gnomon::store
