#include "analysis/tune/tune_goal.hpp"

#include <algorithm>

namespace gnomon::analysis {

TuneLimits limits_of(const TuneGoal& goal, std::span<const ViewOutcome> least_wrong)
{
    const auto relative = [&](std::optional<double> (ViewOutcome::*rate)() const) {
        double worst = 0;
        for (const ViewOutcome& view : least_wrong) {
            worst = std::max(worst, (view.*rate)().value_or(0));
        }
        return std::min(most_relative_limit, relative_limit_factor * worst + relative_limit_spare);
    };
    return {goal.max_shadow_amount_rate.value_or(relative(&ViewOutcome::shadow_rate)),
            goal.max_light_amount_rate.value_or(relative(&ViewOutcome::light_rate)),
            goal.max_false_shadow_rate, goal.max_false_lit_rate, goal.max_resolution_texels};
}

double mean_amount_rate(const ViewOutcome& outcome)
{
    const auto shadow = outcome.shadow_rate();
    const auto light = outcome.light_rate();
    if (shadow && light) {
        return (*shadow + *light) / 2;
    }
    return shadow.value_or(light.value_or(0));
}

} // namespace gnomon::analysis
