#pragma once

#include "api/sweep/sweep.hpp"

#include <filesystem>
#include <string>

namespace gnomon::cli {

/// How a unit of a plan is computed.
struct UnitRunOptions {
    std::filesystem::path plan;   ///< its file
    std::string unit;             ///< its id or its number
    std::filesystem::path folder; ///< for its file
    std::filesystem::path scenes; ///< a folder of packed scenes; empty: none
    bool retries_failed = false;
    bool is_quiet = false;
    api::SessionOptions session;
};

/// How it ended.
struct UnitOutcome {
    std::filesystem::path file; ///< of its results; not there if it was interrupted
    std::uint32_t number = 0;
    std::uint32_t count = 0; ///< of the plan's units
    bool was_known = false;  ///< there was nothing to do: the file was there
    api::SweepOutcome sweep;
};

/// Computes a unit of a plan, unless its file is there. What was computed before it was interrupted
/// or killed is not computed again: until the unit is complete, it is kept in a hidden folder
/// beside the file. Several processes may compute the same unit at a time.
/// @throws scene::InputError        if there is no such unit, its plan is of another version or of
///                                  scenes with another content, or the file is of another plan.
/// @throws scene::EnvironmentError  as `api::sweep` does.
[[nodiscard]] UnitOutcome run_unit(UnitRunOptions options);

} // namespace gnomon::cli
