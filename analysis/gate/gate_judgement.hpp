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

/// What a rule found of a configuration.
enum class GateReason : std::uint8_t {
    above_max,
    below_min,
    worse_than_baseline,
    nothing_tested, ///< so few pixels are scored that all else would pass
    traded_off,     ///< worse than the baseline, by no more than the rule's trade-off: a warning
    not_available,  ///< a value that it takes to judge does not exist
};

/// A rule that a configuration does not keep to.
struct GateFinding {
    std::size_t rule = 0;  ///< index into the rules
    std::size_t entry = 0; ///< index into the run's entries
    GateReason reason = GateReason::worse_than_baseline;
    std::optional<double> before; ///< the baseline's value
    std::optional<double> now;
    std::optional<double> limit; ///< largest change allowed, or the `max` or `min` that is broken
    PixelFilter filter = {};     ///< of which pixels
    std::string obstacle = {};   ///< why a value is not available, where that can be said
    /// The cause of which these pixels have most more than before.
    std::optional<DominantCause> cause = {};
    std::optional<NewPixels> new_pixels = {}; ///< of `new_pixels`: where they are
};

/// The severity of a finding: its rule's, or a warning where it is traded off.
[[nodiscard]] Severity severity_of(const GateFinding& finding, std::span<const GateRule> rules);

/// A metric that a rule on its change judges, and that changed for the better.
struct GateImprovement {
    std::size_t entry = 0; ///< index into the run's entries
    std::string metric;
    double before = 0;
    double now = 0;
};

/// How a gate ends.
enum class GateVerdict : std::uint8_t {
    pass,
    regression,
    incomplete, ///< results are missing, so that nothing is decided
};

/// A configuration that both have.
struct GatePair {
    std::size_t before = 0; ///< index into the baseline's entries
    std::size_t now = 0;    ///< index into the run's
    std::vector<ParameterChange> changes;
    std::optional<DominantCause> cause;
};

/// What a gate finds. Indices are into the entries that were compared.
struct GateOutcome {
    bool is_same_renderer = true;
    std::vector<GatePair> pairs;               ///< by the run's entries
    std::vector<std::size_t> missing;          ///< the baseline's entries that the run lacks
    std::vector<std::size_t> added;            ///< the run's entries that the baseline lacks
    std::vector<GateFinding> findings;         ///< worst first
    std::vector<GateImprovement> improvements; ///< by entry
    std::vector<std::size_t> unmatched_rules;  ///< of no configuration, and not optional

    /// How many findings have that severity; those of values that are not available do not count.
    [[nodiscard]] std::size_t broken(std::span<const GateRule> rules, Severity severity) const;
    /// Whether a rule that fails could not be judged, or configurations are missing.
    [[nodiscard]] bool is_incomplete(std::span<const GateRule> rules) const;
    /// The pair of an entry of the run; nullptr if the baseline lacks it.
    [[nodiscard]] const GatePair* pair_of(std::size_t entry) const;
};

/// Compares a run with a baseline, configuration by configuration and rule by rule. Rules on a
/// change judge configurations that both have; `max` and `min` judge all of the run.
///
/// Worst first: what fails before warnings, values that are not available after all others;
/// then counts of pixels by how many more, then other metrics by how much more for its size.
///
/// Of `new_pixels`, which compares places, an optional rule judges the configurations whose pixels
/// the baseline has; another one cannot judge those whose pixels either lacks.
/// @param ask_new_pixels  May be empty if no rule is of that metric.
[[nodiscard]] GateOutcome judge_run(const GateEntries& baseline, const GateEntries& run,
                                    std::span<const GateRule> rules,
                                    const AskNewPixels& ask_new_pixels = {});

/// `incomplete` if results are missing or a rule that fails could not be judged; else `regression`
/// if a rule that fails is broken; else `pass`.
/// @param is_complete  Whether no configuration of the run failed or is missing.
[[nodiscard]] GateVerdict gate_verdict(const GateOutcome& outcome, std::span<const GateRule> rules,
                                       bool is_complete);

} // namespace gnomon::analysis
