#pragma once

#include "api/sweep/sweep.hpp"
#include "cli/options/job_options.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::cli {

/// How a sweep is computed by the workers of a cluster.
struct ClusterSweepOptions {
    std::string cluster; ///< of --on
    JobOptions job;
    std::vector<std::string> axes; ///< of --axis
    std::size_t units = 0;         ///< at most; 0: such that each takes about a minute
    std::filesystem::path folder;  ///< RUN
    std::string command;           ///< that resumes it
    int threads = 0;               ///< of each process; 0: as the program chooses
    bool allows_mixed = false;
    bool retries_failed = false; ///< computes units anew where a configuration failed
    bool is_quiet = false;
};

/// Plans the sweep, has its units computed, and unites them in RUN as they come. What RUN holds of
/// it is not computed again.
/// @throws scene::InputError        as `plan_sweep`, and if RUN holds another sweep.
/// @throws scene::EnvironmentError  if the cluster, a worker or the disk fails; what was united
///                                  stays.
[[nodiscard]] api::SweepOutcome sweep_on_cluster(const ClusterSweepOptions& options);

} // namespace gnomon::cli
