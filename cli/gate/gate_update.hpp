#pragma once

#include "store/baseline/gate_run.hpp"

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// How `gnomon gate --update` is called.
struct UpdateOptions {
    std::filesystem::path baseline;
    std::string update; ///< "missing", "changed" or "all"
    bool allows_ci = false;
};

/// Ends the program with exit status 5 if the run is incomplete: no baseline is made of it.
/// @throws scene::InputError  if its results come from several environments.
void require_whole_run(const store::GateRun& run);

/// Takes results of the run into the baseline, and prints what changes in it.
///
/// Ends the program with exit status 3 if the baseline is of another environment, and not all of it
/// is replaced.
/// @throws scene::InputError  where CI is set and that was not allowed; as `require_whole_run`, and
///                            as reading and writing baselines do.
void update_baseline(const UpdateOptions& options, const store::GateRun& run);

} // namespace gnomon::cli
