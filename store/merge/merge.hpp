#pragma once

#include "store/run/run_store.hpp"

#include <filesystem>
#include <span>

namespace gnomon::store {

/// Unites runs of one sweep, be they its shards or overlapping, in a new run, and writes its CSV
/// files: those of the undivided run, byte for byte, if nothing is missing.
///
/// Results win over failures, and failures over nothing. A merge that was cut short is done anew.
/// @param out   A folder without a run; the caller holds its lock.
/// @param runs  At least one; they stay as they are.
/// @return  How the union's configurations stand; `planned` counts those that no run knows of too.
/// @throws scene::InputError  if a folder holds no run, or `out` holds one; if the runs are of
///                            different sweeps, or of several environments that are not allowed; if
///                            two results of one configuration differ: it names that, and the
///                            column.
/// @throws scene::EnvironmentError  as `RunStore` does.
PlanOutcome merge_runs(const std::filesystem::path& out,
                       std::span<const std::filesystem::path> runs, Environments environments);

} // namespace gnomon::store
