#pragma once

#include "cli/system/guarded_process.hpp"
#include "store/units/unit_plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// Where the units of a sweep are computed, as `--on` says it.
struct Cluster {
    std::string name;         ///< "local:4", "dask://host:8786", "slurm" or "slurm:OPTIONS"
    std::string driver;       ///< the script of the folder `clusters` that knows it
    bool shares_files = true; ///< its workers see this machine's, under the same names
};

/// @throws scene::InputError  if it is none.
[[nodiscard]] Cluster read_cluster(const std::string& name);

/// What a driver is told once.
struct ClusterOrder {
    std::filesystem::path plan;   ///< its file
    std::filesystem::path folder; ///< for units' files
    std::filesystem::path scenes; ///< packed, for workers that lack their files; empty: none do
    int threads = 0;              ///< of each process; 0: as the program chooses
    bool allows_mixed = false;    ///< workers of several environments
    bool retries_failed = false;  ///< also what a worker computed before, and failed
};

/// Something that a driver says.
struct ClusterEvent {
    enum class Kind {
        none,   ///< nothing, in the time that was given
        worker, ///< there is one; what GL is there
        unit,   ///< a unit's file is in the folder
        failed, ///< a unit was tried several times, in vain
        ended,  ///< nothing more will come
    };
    Kind kind = Kind::none;
    std::string subject; ///< the worker, or the unit's id
    std::string text;    ///< where the unit was computed, what GL is, or what went wrong
};

/// A cluster's driver, a program of its own that hands units to workers and leaves their files in a
/// folder (docs/scaling.md#drivers). Nothing that it starts on this machine outlives it.
class ClusterDriver {
public:
    /// @param units  that are to be computed.
    /// @throws scene::EnvironmentError  if it cannot be started.
    ClusterDriver(const Cluster& cluster, const ClusterOrder& order,
                  const std::vector<const store::PlannedUnit*>& units);

    /// What it says next.
    /// @throws scene::EnvironmentError  if it says that it cannot go on, or ends without a word.
    [[nodiscard]] ClusterEvent next();

    /// Asks it to end: what runs is stopped where it can be gone on with.
    void stop();

private:
    void require_write(const std::string& line);

    const Cluster& cluster_;
    GuardedProcess process_;
};

} // namespace gnomon::cli
