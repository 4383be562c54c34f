#pragma once

#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// The progress of a run.
struct RunStatus {
    std::filesystem::path folder;
    RunDescription description;
    std::uint64_t done = 0;
    std::uint64_t failed = 0;
    std::uint64_t missing = 0;
    std::uint64_t retriable = 0; ///< failed ones that may pass when tried again
    RunChecks checks;
    std::vector<RunRow> failed_rows;  ///< the first ones
    std::vector<RunRow> missing_rows; ///< the first ones in the run's plan
    RunSchema schema;

    [[nodiscard]] bool is_complete() const { return failed == 0 && missing == 0; }
};

/// @param most  rows of each list.
/// @throws scene::InputError  if the folder holds no run, or a run without a plan.
[[nodiscard]] RunStatus read_run_status(const std::filesystem::path& folder, std::uint64_t most);

/// The command that resumes a run; empty if it is unknown, or the run has an older schema.
[[nodiscard]] std::string resuming_command(const RunStatus& status);

} // namespace gnomon::store
