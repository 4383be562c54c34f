#pragma once

#include "reports/run/sqlite.hpp"

#include <filesystem>

namespace gnomon::reports {

/// `RunStore::write_csv`: all three files show the database at one moment.
void write_run_csv(const sqlite::Database& database, const std::filesystem::path& folder);

} // namespace gnomon::reports
