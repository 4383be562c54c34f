#pragma once

#include "analysis/advice/lookup_cost.hpp"
#include "analysis/advice/view_outcome.hpp"
#include "analysis/recommendation/recommendation.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
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

/// How many metres a step of the map's format is at the median receiver, before and after a change.
struct DepthStepChange {
    double before_m = 0;
    double after_m = 0;
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
};

/// A method that a search over methods has left out.
struct PassedOverMethod {
    std::string method;
    std::string reason; ///< one line
};

} // namespace gnomon::analysis
