#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_rules.hpp"
#include "analysis/gate/new_pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Why a rule reports a configuration.
enum class GateReason : std::uint8_t {
    above_max,
    below_min,
    worse_than_baseline,
    nothing_tested, ///< so few pixels are scored that all else would pass
    traded_off,     ///< worse than the baseline, but within the rule's trade-off: a warning
    not_available,  ///< a value that the rule needs does not exist
};

/// A configuration that breaks a rule.
struct GateFinding {
    std::size_t rule = 0;  ///< index into the rules
    std::size_t entry = 0; ///< index into the run's entries
    GateReason reason = GateReason::worse_than_baseline;
    std::optional<double> before; ///< the baseline's value
    std::optional<double> now;
    std::optional<double> limit; ///< largest change allowed, or the broken `max` or `min`
    PixelFilter filter = {};     ///< the pixels that count
    std::string obstacle = {};   ///< why a value is not available, if known
    /// The cause that grew most among these pixels.
    std::optional<DominantCause> cause = {};
    std::optional<NewPixels> new_pixels = {}; ///< for `new_pixels`: where they are
};

/// The severity of a finding: its rule's, or a warning if it is traded off.
[[nodiscard]] Severity severity_of(const GateFinding& finding, std::span<const GateRule> rules);

/// A metric that changed for the better, under a rule on its change.
struct GateImprovement {
    std::size_t entry = 0; ///< index into the run's entries
    std::string metric;
    double before = 0;
    double now = 0;
};

/// The outcome of a gate.
enum class GateVerdict : std::uint8_t {
    pass,
    regression,
    incomplete, ///< results are missing, so nothing is decided
};

/// A configuration of both baseline and run.
struct GatePair {
    std::size_t before = 0; ///< index into the baseline's entries
    std::size_t now = 0;    ///< index into the run's
    std::vector<ParameterChange> changes;
    std::optional<DominantCause> cause;
};

/// The findings of a gate. Indices are into the entries that were compared.
struct GateOutcome {
    bool is_same_renderer = true;
    std::vector<GatePair> pairs;               ///< by the run's entries
    std::vector<std::size_t> missing;          ///< the baseline's entries that the run lacks
    std::vector<std::size_t> added;            ///< the run's entries that the baseline lacks
    std::vector<GateFinding> findings;         ///< worst first
    std::vector<GateImprovement> improvements; ///< by entry
    std::vector<std::size_t> unmatched_rules;  ///< that match no configuration and are not optional

    /// The number of findings of a severity, without those whose value is not available.
    [[nodiscard]] std::size_t broken(std::span<const GateRule> rules, Severity severity) const;
    /// Whether a rule of severity `fail` could not be judged, or configurations are missing.
    [[nodiscard]] bool is_incomplete(std::span<const GateRule> rules) const;
    /// The pair of an entry of the run; nullptr if the baseline lacks it.
    [[nodiscard]] const GatePair* pair_of(std::size_t entry) const;
};

/// Compares a run with a baseline, configuration by configuration and rule by rule. Rules on a
/// change judge configurations of both; `max` and `min` judge all of the run.
///
/// Findings are sorted worst first: failures before warnings, unavailable values last; then counts
/// of pixels by growth, then other metrics by relative growth.
///
/// `new_pixels` compares places. An optional rule on it judges only configurations whose pixels the
/// baseline has; for other rules, missing pixels are a finding.
/// @param ask_new_pixels  May be empty if no rule is on that metric.
[[nodiscard]] GateOutcome judge_run(const GateEntries& baseline, const GateEntries& run,
                                    std::span<const GateRule> rules,
                                    const AskNewPixels& ask_new_pixels = {});

/// `incomplete` if results are missing or a rule of severity `fail` could not be judged; else
/// `regression` if such a rule is broken; else `pass`.
/// @param is_complete  Whether no configuration of the run failed or is missing.
[[nodiscard]] GateVerdict gate_verdict(const GateOutcome& outcome, std::span<const GateRule> rules,
                                       bool is_complete);

} // namespace gnomon::analysis
