#pragma once

namespace gnomon::store {

/// Of the database's tables and of the CSV files' columns.
inline constexpr int run_schema = 2;

} // namespace gnomon::store
