#pragma once

#include "cli/system/guarded_process.hpp"
#include "store/units/unit_plan.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A cluster, as --on names it.
struct Cluster {
    std::string name;         ///< "local:4", "dask://host:8786", "slurm" or "slurm:OPTIONS"
    std::string driver;       ///< the script in the folder `clusters`
    bool shares_files = true; ///< its workers see this machine's files under the same paths
};

/// @throws scene::InputError  if the name is not valid.
[[nodiscard]] Cluster read_cluster(const std::string& name);

/// The options of a driver.
struct ClusterOrder {
    std::filesystem::path plan;   ///< its file
    std::filesystem::path folder; ///< for the units' files
    std::filesystem::path scenes; ///< packed scenes for workers without the files; may be empty
    int threads = 0;              ///< of each process; 0: chosen by the program
    bool allows_mixed = false;    ///< workers of several environments
    bool retries_failed = false;  ///< recompute failed configurations
};

/// An event that a driver reports.
struct ClusterEvent {
    enum class Kind {
        none,   ///< nothing in time
        worker, ///< a worker has started
        unit,   ///< a unit's file is in the folder
        failed, ///< a unit failed several times
        ended,  ///< the last event
    };
    Kind kind = Kind::none;
    std::string subject; ///< the worker, or the unit's id
    std::string text;    ///< the unit's worker, the worker's GL renderer, or the error
};

/// A cluster's driver: a process that hands units to workers and puts their files in a folder
/// (docs/scaling.md#drivers). Its processes on this machine end with it.
class ClusterDriver {
public:
    /// @param units  to compute.
    /// @throws scene::EnvironmentError  if it cannot be started.
    ClusterDriver(const Cluster& cluster, const ClusterOrder& order,
                  const std::vector<const store::PlannedUnit*>& units);

    /// The next event.
    /// @throws scene::EnvironmentError  if the driver reports an error, or fails.
    [[nodiscard]] ClusterEvent next();

    /// Asks it to end; units that run stop where they can resume.
    void stop();

private:
    void require_write(const std::string& line);

    const Cluster& cluster_;
    GuardedProcess process_;
};

} // namespace gnomon::cli
