#pragma once

#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::store {

/// `RunStore::plan`, in one transaction.
PlanOutcome write_plan(const sqlite::Database& database, const RunDescription& description,
                       const ShowConfigurations& show, Environments environments,
                       OtherScenes other_scenes);

/// `RunStore::has_configurations`
[[nodiscard]] bool has_configurations(const sqlite::Database& database);

/// Counts this part's configurations by state; what is only `plan`'s is left at its default.
[[nodiscard]] PlanOutcome read_outcome(const sqlite::Database& database);

/// `RunStore::retriable`
[[nodiscard]] std::uint64_t read_retriable(const sqlite::Database& database);

/// `RunStore::description`; everything is empty where nothing was planned yet.
[[nodiscard]] RunDescription read_description(const sqlite::Database& database);

/// The axes of the last plan (`RunDescription::axes`).
[[nodiscard]] std::vector<std::string> read_axes(const sqlite::Database& database);

/// Another renderer's own keys that configurations of the last plan have in their `light_values`.
[[nodiscard]] std::vector<std::string> read_engine_keys(const sqlite::Database& database);

/// Records what the run is, as part of a transaction.
void write_description(const sqlite::Database& database, const RunDescription& description);

/// The number under which the environment of the last plan is recorded; 0 without a plan.
[[nodiscard]] std::int64_t environment_number(const sqlite::Database& database);

} // namespace gnomon::store
