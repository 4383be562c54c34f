#pragma once

#include "analysis/gate/gate_judgement.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "store/baseline/gate_run.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::reports {

/// All that `gnomon gate` says.
struct GateReport {
    std::filesystem::path baseline_file;
    analysis::GateEntries baseline;
    store::GateRun run;
    std::vector<analysis::GateRule> rules;
    analysis::GateOutcome outcome;
    analysis::GateVerdict verdict = analysis::GateVerdict::pass;
    std::map<std::size_t, std::filesystem::path> pictures = {}; ///< by the finding's index
};

/// The file of a finding's picture; empty if it has none.
/// @param finding  One of the report's.
[[nodiscard]] inline std::string picture_of(const GateReport& report,
                                            const analysis::GateFinding& finding)
{
    const auto found =
        report.pictures.find(static_cast<std::size_t>(&finding - report.outcome.findings.data()));
    return found == report.pictures.end() ? std::string{} : found->second.string();
}

/// The cause of which a finding's pixels have most more than before; of a metric that is no count
/// of pixels, the configuration's.
[[nodiscard]] inline std::optional<analysis::DominantCause>
cause_of_finding(const GateReport& report, const analysis::GateFinding& finding)
{
    if (finding.cause) {
        return finding.cause;
    }
    const analysis::GatePair* const pair = report.outcome.pair_of(finding.entry);
    return pair == nullptr ? std::nullopt : pair->cause;
}

} // namespace gnomon::reports
