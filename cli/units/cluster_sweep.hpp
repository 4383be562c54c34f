#pragma once

#include "api/sweep/sweep.hpp"
#include "cli/options/job_options.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The options of a sweep on a cluster.
struct ClusterSweepOptions {
    std::string cluster; ///< the value of --on
    JobOptions job;
    std::vector<std::string> axes; ///< the values of --axis
    std::size_t units = 0;         ///< at most; 0: about a minute for each
    std::filesystem::path folder;  ///< RUN
    std::string command;           ///< resumes the sweep
    int threads = 0;               ///< of each process; 0: chosen by the program
    bool allows_mixed = false;
    bool retries_failed = false; ///< recomputes units with failed configurations
    bool is_quiet = false;
};

/// Plans the sweep, has its units computed, and merges them into RUN as they arrive. Units that RUN
/// holds are skipped.
/// @throws scene::InputError        as `plan_sweep`, and if RUN holds another sweep.
/// @throws scene::EnvironmentError  if the cluster, a worker or the disk fails; RUN keeps what was
///                                  merged.
[[nodiscard]] api::SweepOutcome sweep_on_cluster(const ClusterSweepOptions& options);

} // namespace gnomon::cli
