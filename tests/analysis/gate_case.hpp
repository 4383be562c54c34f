#pragma once

#include "analysis/gate/gate_judgement.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A configuration of 10,000 pixels, identified by its bias.
inline GateEntry gate_entry(const std::string& bias, std::map<std::string, double> metrics,
                            std::map<std::string, std::string> parameters = {})
{
    metrics.emplace("pixels.total", 10'000);
    return {{"", {{"bias.constant", bias}}}, std::move(parameters), std::move(metrics)};
}

inline GateEntries gate_entries(std::vector<GateEntry> entries)
{
    GateEntries run{
        {"llvmpipe", "4.5 Mesa", "Embree 3.13.5", "0.1.0"}, {"bias.constant"}, std::move(entries)};
    (void)sort_entries(run);
    return run;
}

inline GateRule gate_rule(const std::string& metric)
{
    GateRule rule;
    rule.id = "the rule";
    rule.metric = metric;
    rule.worse = find_gate_metric(metric)->worse;
    return rule;
}

/// Judges by one rule a configuration whose metric was `before` and is `now`.
inline GateOutcome judged(const GateRule& rule, double before, double now)
{
    const std::vector<GateRule> rules{rule};
    return judge_run(gate_entries({gate_entry("0", {{rule.metric, before}})}),
                     gate_entries({gate_entry("0", {{rule.metric, now}})}), rules);
}

inline std::size_t finding_count(const GateRule& rule, double before, double now)
{
    return judged(rule, before, now).findings.size();
}

} // namespace gnomon::analysis
