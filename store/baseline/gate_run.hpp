#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_metrics.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "store/run/run_status.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// A run as the gate sees it.
struct GateRun {
    std::filesystem::path folder;
    RunStatus status;
    analysis::GateEntries results; ///< of the configurations that are done
    bool has_several_environments = false;
};

/// @param points  Of bias curves, whose counts or rates are wanted beside what is always read.
/// @throws scene::InputError  if there is no run, or two of its configurations have the same case
///                            and axes.
/// @throws scene::EnvironmentError  as `RunStore` does.
[[nodiscard]] GateRun read_gate_run(const std::filesystem::path& folder,
                                    const std::vector<analysis::CurvePointMetric>& points = {});

/// The points of bias curves that rules are about.
[[nodiscard]] std::vector<analysis::CurvePointMetric>
curve_points_of(const std::vector<analysis::GateRule>& rules);

/// The command that computes one of its configurations with all its layers; empty if not known.
[[nodiscard]] std::string showing_command(const GateRun& run,
                                          const analysis::ConfigurationKey& key);

} // namespace gnomon::store
