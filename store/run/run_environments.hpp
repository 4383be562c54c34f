#pragma once

#include "analysis/environment.hpp"
#include "store/sqlite.hpp"

#include <cstdint>

/// The environments that the results of a run come from.
namespace gnomon::store {

/// The environment's number; it is recorded if it was not.
[[nodiscard]] std::int64_t record_environment(const sqlite::Database& database,
                                              const analysis::Environment& environment);

/// The environment of that number, or one with empty texts.
[[nodiscard]] analysis::Environment find_environment(const sqlite::Database& database,
                                                     std::int64_t number);

/// @throws scene::InputError  naming what differs, if a result is of another environment.
void require_one_environment(const sqlite::Database& database, const analysis::Environment& here);

} // namespace gnomon::store
