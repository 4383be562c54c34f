#pragma once

#include "analysis/comparison/view_outcome.hpp"

namespace gnomon::analysis {

/// What the user asks of a shadow map: of amounts without what a kernel softens on purpose, and of
/// counts; of each view by itself.
struct TuneLimits {
    double max_shadow_amount_rate = 0.001; ///< of the scored lit pixels
    double max_light_amount_rate = 0.005;  ///< of the scored blocked pixels
    double max_false_shadow_rate = 1;      ///< by count
    double max_false_lit_rate = 1;
    int max_resolution_texels = 4096;
};

/// Limits that every setting meets.
[[nodiscard]] constexpr TuneLimits no_limits()
{
    return {.max_shadow_amount_rate = 1, .max_light_amount_rate = 1};
}

/// Whether each rate is at most its limit; one without a denominator meets every limit.
[[nodiscard]] bool meets(const ViewOutcome& outcome, const TuneLimits& limits);

/// The constant biases with which a view meets the limits, where each verdict is one comparison;
/// those that a job can have, from 0 on.
/// @return  Empty if there is none.
[[nodiscard]] std::optional<BiasInterval> biases_within(const BiasCurve& curve,
                                                        const TuneLimits& limits);

} // namespace gnomon::analysis
