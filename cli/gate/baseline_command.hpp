#pragma once

#include "store/baseline/gate_run.hpp"

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// The options of `gnomon gate --update`.
struct UpdateOptions {
    std::filesystem::path baseline;
    std::string update; ///< "missing", "changed" or "all"
    bool allows_ci = false;
};

/// Ends the program with exit status 5 if the run is incomplete.
/// @throws scene::InputError  if its results come from several environments.
void require_whole_run(const store::GateRun& run);

/// Updates the baseline with the run's results, and prints the changes.
///
/// Ends the program with exit status 3 if the baseline is of another environment, unless all of it
/// is replaced.
/// @throws scene::InputError  if CI is set without --allow-ci-update; as `require_whole_run`, and
///                            as reading and writing baselines do.
void update_baseline(const UpdateOptions& options, const store::GateRun& run);

} // namespace gnomon::cli
