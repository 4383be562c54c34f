#pragma once

#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gnomon::store {

/// What a merge made.
struct MergeOutcome {
    /// How the union's configurations stand; `planned` counts those that nobody knows of, too.
    PlanOutcome counts;
    std::vector<std::string> damaged; ///< of each unit's file that is not whole, what is to be said
    std::uint64_t repeated = 0;       ///< files of units that another file was of
    std::vector<std::uint32_t> missing_units; ///< numbers of those that no whole file is of
    std::uint32_t unit_count = 0;             ///< of the plan; 0: no unit was united
};

/// Unites runs of one sweep, be they its shards or overlapping, and units of one plan, in a new
/// run, and writes its CSV files: those of the undivided run, byte for byte, if nothing is missing.
///
/// Results win over failures, and failures over nothing. A merge that was cut short is done anew.
/// @param out   A folder without a run; the caller holds its lock.
/// @param runs  At least one: folders of runs, units' files, and folders of these. They stay as
/// they
///              are. A unit's file that is not whole is left out, as long as there is another.
/// @throws scene::InputError  if a folder holds no run, or `out` holds one; if the runs are of
///                            different sweeps, the units of different plans, or of several
///                            environments that are not allowed; if two results of one
///                            configuration differ: it names that, and the column.
/// @throws scene::EnvironmentError  as `RunStore` does.
MergeOutcome merge_runs(const std::filesystem::path& out,
                        std::span<const std::filesystem::path> runs, Environments environments);

} // namespace gnomon::store
