#pragma once

#include "analysis/comparison/lookup_cost.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/metrics/named_errors.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "scene/settings/job.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// How it is known what a change leaves.
enum class MeasuredBy : std::uint8_t {
    rerun,       ///< GL was run again with it
    curve,       ///< the bias curve holds it, exactly
    slope_curve, ///< the bias curve of another slope does
};
inline constexpr std::array<std::string_view, 3> measured_by_names{"rerun", "curve", "slope_curve"};

/// How a change of the scene in place of the job begins.
inline constexpr std::string_view origin_comment = "# move ";

/// How many metres a step of the map's format is at the median receiver, before and after a change.
struct DepthStepChange {
    double before_m = 0;
    double after_m = 0;
};

/// What a change does to the biases that the job sets, the better the sooner.
enum class BiasChange : std::uint8_t {
    mends,              ///< takes one away, halves it, shortens it or turns it round, and adds none
    mends_and_shortens, ///< and sets a shorter constant bias than the job would need as it is
    other,
};

/// One change of the job's settings, and what it leaves.
struct Remedy {
    std::vector<std::string>
        keys; ///< what changes, as the job file writes it: "bias.constant = 0.002"
    Outcome outcome;
    std::optional<double> error_rate; ///< by count; empty: no scored pixel
    LookupCost cost;
    MeasuredBy measured_by = MeasuredBy::rerun;
    std::optional<BiasLength> bias = {}; ///< the constant bias that it sets; empty: it sets none
    std::vector<ViewOutcome> views = {}; ///< in each view, the job's own first; empty: not measured
    DepthStepChange step = {};           ///< 0: not known
    BiasChange bias_change = BiasChange::other;
    std::shared_ptr<const scene::Job> job = {}; ///< with the change; null: it is not told
    std::optional<NamedErrors> left = {};       ///< what it leaves, by name; empty: not known
};

/// The cure of a cause, applied alone.
struct Cure {
    Cause cause = Cause::none;
    std::vector<std::string> keys; ///< what changes, as the job file writes it
    double laid = 0;               ///< the error that is laid to the cause [px]
    Outcome outcome;
    MeasuredBy measured_by = MeasuredBy::rerun;
    std::optional<NamedErrors> left = {}; ///< empty: not known

    /// Whether it takes away at least half of what is laid to its cause.
    /// @param now  The error of the job as it is [px].
    [[nodiscard]] bool cures(double now) const
    {
        constexpr double half = 0.5;
        return laid > 0 && now - outcome.error_amount() >= half * laid;
    }
};

/// A method that a search over methods has left out.
struct PassedOverMethod {
    std::string method;
    std::string reason; ///< one line
};

} // namespace gnomon::analysis
