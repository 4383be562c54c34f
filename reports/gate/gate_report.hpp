#pragma once

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "reports/gate/gate_run.hpp"

#include <filesystem>
#include <vector>

namespace gnomon::reports {

/// All that `gnomon gate` says.
struct GateReport {
    std::filesystem::path baseline_file;
    analysis::GateEntries baseline;
    GateRun run;
    std::vector<analysis::GateRule> rules;
    analysis::GateOutcome outcome;
    analysis::GateVerdict verdict = analysis::GateVerdict::pass;
};

} // namespace gnomon::reports
