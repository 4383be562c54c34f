#pragma once

#include "store/sqlite.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace gnomon::store {

/// What `write_run_csv` writes; the last where a finished configuration has several maps.
inline constexpr std::array<std::string_view, 4> run_csv_names{"results.csv", "error_vs_z.csv",
                                                               "bias_curves.csv", "by_map.csv"};

/// A value as the CSV files have it, but a text as it is; empty for none.
[[nodiscard]] std::string cell_text(const sqlite::ValueView& value);

/// `RunStore::write_csv`: all files show the database at one moment.
void write_run_csv(const sqlite::Database& database, const std::filesystem::path& folder);

} // namespace gnomon::store
