#pragma once

#include "analysis/comparison/view_outcome.hpp"

namespace gnomon::analysis {

/// The requested limits for each view: for amounts without intended softening, and for counts.
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

/// The constant biases from 0 on at which a view meets the limits, if each verdict is one
/// comparison.
/// @return  Empty if no bias does.
[[nodiscard]] std::optional<BiasInterval> biases_within(const BiasCurve& curve,
                                                        const TuneLimits& limits);

} // namespace gnomon::analysis
