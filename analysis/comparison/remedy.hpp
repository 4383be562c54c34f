#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "methods/job_method.hpp"
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

/// The cost of a setting.
struct LookupCost {
    std::uint64_t map_bytes = 0; ///< memory of the map
    int taps = 1;                ///< texels per verdict, including those that GL reads in one call

    friend auto operator<=>(const LookupCost&, const LookupCost&) = default;
};

/// The cost of the job's map and lookups.
[[nodiscard]] inline LookupCost lookup_cost(const scene::Job& job)
{
    const methods::LookupTraits traits = methods::traits(job);
    return {traits.map_bytes, static_cast<int>(traits.tap_count())};
}

/// How the effect of a change is known.
enum class MeasuredBy : std::uint8_t {
    rerun,       ///< GL was run again with it
    curve,       ///< from the bias curve, exactly
    slope_curve, ///< from the bias curve of another slope
};
inline constexpr std::array<std::string_view, 3> measured_by_names{"rerun", "curve", "slope_curve"};

/// Prefix of a change to the scene instead of the job.
inline constexpr std::string_view origin_comment = "# move ";

/// Size of a step of the map's format at the median receiver, before and after a change.
struct DepthStepChange {
    double before_m = 0;
    double after_m = 0;
};

/// The effect of a change on the biases that the job sets; the first is the best.
enum class BiasChange : std::uint8_t {
    mends,              ///< removes, halves, shortens or reverses one, and adds none
    mends_and_shortens, ///< also sets a shorter constant bias than the unchanged job needs
    other,
};

/// One change of the job's settings, and its effect.
struct Remedy {
    /// What changes, as the job file writes it: "bias.constant = 0.002".
    std::vector<std::string> keys;
    Outcome outcome;
    std::optional<double> error_rate; ///< by count; empty without scored pixels
    LookupCost cost;
    MeasuredBy measured_by = MeasuredBy::rerun;
    std::optional<BiasLength> bias = {}; ///< the constant bias that it sets; empty if it sets none
    /// In each view, the job's own first; empty if not measured.
    std::vector<ViewOutcome> views = {};
    DepthStepChange step = {}; ///< 0 if unknown
    BiasChange bias_change = BiasChange::other;
    std::shared_ptr<const scene::Job> job = {}; ///< the changed job; null if not reported
    std::optional<NamedErrors> left = {};       ///< remaining errors; empty if unknown
};

/// The cure of one cause, applied alone.
struct Cure {
    Cause cause = Cause::none;
    std::vector<std::string> keys; ///< the changes, as the job file writes them
    double laid = 0;               ///< the error attributed to the cause [px]
    Outcome outcome;
    MeasuredBy measured_by = MeasuredBy::rerun;
    std::optional<NamedErrors> left = {}; ///< remaining errors; empty if unknown

    /// Whether it removes at least half of the error attributed to its cause.
    /// @param now  The error of the unchanged job [px].
    [[nodiscard]] bool cures(double now) const
    {
        constexpr double half = 0.5;
        return laid > 0 && now - outcome.error_amount() >= half * laid;
    }
};

/// A method that a search over methods skipped.
struct PassedOverMethod {
    std::string method;
    std::string reason; ///< one line
};

} // namespace gnomon::analysis
