#pragma once

#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// How far a run is.
struct RunStatus {
    std::filesystem::path folder;
    RunDescription description;
    std::uint64_t done = 0;
    std::uint64_t failed = 0;
    std::uint64_t missing = 0;
    std::uint64_t retriable = 0; ///< of the failed, those that may pass when tried again
    RunChecks checks;
    std::vector<RunRow> failed_rows;  ///< the first of them
    std::vector<RunRow> missing_rows; ///< the first of those that the run knows of
    RunSchema schema;

    [[nodiscard]] bool is_complete() const { return failed == 0 && missing == 0; }
};

/// @param most  rows of each list.
/// @throws scene::InputError  if there is no run, or nothing was planned in it.
[[nodiscard]] RunStatus read_run_status(const std::filesystem::path& folder, std::uint64_t most);

/// The command that goes on with a run; empty if it is not known, or the run is of an older schema.
[[nodiscard]] std::string resuming_command(const RunStatus& status);

} // namespace gnomon::store
