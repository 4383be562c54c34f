#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_metrics.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "store/json.hpp"
#include "store/run/run_status.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// The part of a run that the gate compares.
struct GateRun {
    std::filesystem::path folder;
    RunStatus status;
    analysis::GateEntries results; ///< of the finished configurations
    bool has_several_environments = false;
};

/// @param points  points of bias curves to read as additional metrics.
/// @throws scene::InputError  if the folder holds no run, or two configurations have the same case
///                            and axes.
/// @throws scene::EnvironmentError  as `RunStore` does.
[[nodiscard]] GateRun read_gate_run(const std::filesystem::path& folder,
                                    const std::vector<analysis::CurvePointMetric>& points = {});

/// The points of bias curves that the rules limit.
[[nodiscard]] std::vector<analysis::CurvePointMetric>
curve_points_of(const std::vector<analysis::GateRule>& rules);

/// The command that computes one configuration with all its layers; empty if unknown.
[[nodiscard]] std::string showing_command(const GateRun& run,
                                          const analysis::ConfigurationKey& key);

/// "noon, bias.constant = 0.01" on one line; "the only configuration" without case and axes.
[[nodiscard]] std::string key_text(const analysis::ConfigurationKey& key);
/// {"case": "noon", "axes": {"bias.constant": "0.01"}}
[[nodiscard]] Json key_json(const analysis::ConfigurationKey& key);

/// A count as an integer, any other metric as a real number, a missing one as null.
[[nodiscard]] Json metric_json(std::string_view metric, const std::optional<double>& value);

} // namespace gnomon::store
