#pragma once

#include "store/run/run_types.hpp"
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

/// Records what the run is, as part of a transaction.
void write_description(const sqlite::Database& database, const RunDescription& description);

} // namespace gnomon::store
