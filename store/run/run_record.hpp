#pragma once

#include "store/run/run_types.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// What a run is, as its database has it.
namespace gnomon::store {

/// `RunStore::description`; everything is empty where nothing was planned yet.
[[nodiscard]] RunDescription read_description(const sqlite::Database& database);

/// The axes of the last plan (`RunDescription::axes`).
[[nodiscard]] std::vector<std::string> read_axes(const sqlite::Database& database);

/// Another renderer's own keys that configurations of the last plan have in their `light_values`.
[[nodiscard]] std::vector<std::string> read_engine_keys(const sqlite::Database& database);

/// The number under which the environment of the last plan is recorded; 0 without a plan.
[[nodiscard]] std::int64_t environment_number(const sqlite::Database& database);

} // namespace gnomon::store
