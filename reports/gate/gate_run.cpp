#include "reports/gate/gate_run.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "reports/gate/gate_names.hpp"
#include "reports/page/run_overview.hpp"
#include "reports/page/run_reader.hpp"
#include "reports/run/run_columns.hpp"
#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

analysis::GateEntry entry_of(const ResultRow& row, const std::vector<std::string>& axes)
{
    analysis::GateEntry entry;
    entry.key.case_name = row.text("case");
    for (const std::string& axis : axes) {
        entry.key.axes[axis] = row.text(axis);
    }
    for (auto& [key, value] : job_settings(row)) {
        if (!entry.key.axes.contains(key)) {
            entry.parameters.emplace(std::move(key), std::move(value));
        }
    }
    if (std::string hash = row.text("scene_hash"); !hash.empty()) {
        entry.parameters.emplace("scene_hash", std::move(hash));
    }
    for (const analysis::GateMetric& metric : analysis::gate_metrics()) {
        if (const auto value = row.number(metric.name); value && std::isfinite(*value)) {
            entry.metrics.emplace(metric.name, *value);
        }
    }
    return entry;
}

} // namespace

GateRun read_gate_run(const std::filesystem::path& folder)
{
    GateRun run;
    run.status = read_run_status(folder, 0);
    const RunReader reader{folder};
    run.results.environment = reader.description().environment;
    run.results.axes = reader.description().axes;
    for (const ResultRow& row : reader.rows("WHERE status = 'done' ORDER BY ordinal")) {
        run.results.entries.push_back(entry_of(row, run.results.axes));
    }
    run.has_several_environments =
        reader.database().integer("SELECT count(DISTINCT c.environment) FROM part p"
                                  " JOIN configurations c ON c.number = p.configuration"
                                  " WHERE c.status = 'done'") > 1;
    if (const auto twins = sort_entries(run.results)) {
        throw scene::InputError(fmt::format(
            "{}: two configurations are {}: give the axes values that differ",
            scene::one_line(folder.string()), key_text(run.results.entries[twins->first].key)));
    }
    return run;
}

std::string showing_command(const GateRun& run, const analysis::ConfigurationKey& key)
{
    return compare_command(run.status.description, key.case_name,
                           {key.axes.begin(), key.axes.end()});
}

} // namespace gnomon::reports
