#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "reports/run/run_status.hpp"

#include <filesystem>
#include <string>

namespace gnomon::reports {

/// A run as the gate sees it.
struct GateRun {
    RunStatus status;
    analysis::GateEntries results; ///< of the configurations that are done
    bool has_several_environments = false;
};

/// @throws scene::InputError  if there is no run, or two of its configurations have the same case
///                            and axes.
/// @throws scene::EnvironmentError  as `RunStore` does.
[[nodiscard]] GateRun read_gate_run(const std::filesystem::path& folder);

/// The command that computes one of its configurations with all its layers; empty if not known.
[[nodiscard]] std::string showing_command(const GateRun& run,
                                          const analysis::ConfigurationKey& key);

} // namespace gnomon::reports
