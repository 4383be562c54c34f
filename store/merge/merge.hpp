#pragma once

#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// The result of a merge.
struct MergeOutcome {
    /// The configurations by state; `planned` includes those that no input contains.
    PlanOutcome counts;
    std::vector<std::string> damaged;         ///< a message for each damaged unit file
    std::uint64_t repeated = 0;               ///< files of units that another file holds, too
    std::vector<std::uint32_t> missing_units; ///< numbers of units without an intact file
    std::uint32_t unit_count = 0;             ///< of the plan; 0: no units were merged
};

/// Unites runs of one sweep, be they its shards or overlapping, and units of one plan, in a new
/// run, and writes its CSV files: those of the undivided run, byte for byte, if nothing is missing.
///
/// Results win over failures, and failures over nothing. A merge that was cut short is done anew.
/// @param out   A folder without a run; the caller holds its lock.
/// @param runs  At least one: folders of runs, units' files, and folders of these. They stay as
///              they are. A unit's file that is not whole is left out, as long as there is another.
/// @throws scene::InputError  if a folder holds no run, or `out` holds one; if the runs are of
///                            different sweeps, the units of different plans, or of several
///                            environments that are not allowed; if two results of one
///                            configuration differ: it names that, and the column.
/// @throws scene::EnvironmentError  as `RunStore` does.
MergeOutcome merge_runs(const std::filesystem::path& out,
                        std::span<const std::filesystem::path> runs, Environments environments);

/// Refuses to merge a run or a unit file.
/// @throws scene::InputError  always: "run: what".
[[noreturn]] void refuse_input(const std::filesystem::path& run, std::string_view what);

/// Adds the results of another database to those of a run, in one transaction: results win over
/// failures, and failures over nothing.
/// @param input  the other database.
/// @param run    its name in messages.
/// @param more   runs within the same transaction; may be empty.
/// @throws scene::InputError  if it is of another sweep, or two results of one configuration
///                            differ.
void merge_into(const sqlite::Database& database, const std::filesystem::path& input,
                const std::filesystem::path& run, const std::function<void()>& more = {});

} // namespace gnomon::store
