#pragma once

#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison/view_outcome.hpp"

#include <functional>
#include <optional>
#include <span>

namespace gnomon::analysis {

/// How far each amount rate may be from that of the least wrong setting, where no limit is given.
inline constexpr double relative_limit_factor = 1.25;
inline constexpr double relative_limit_spare = 0.0002;
inline constexpr double most_relative_limit = 0.5; ///< no setting serves that takes half the shadow

/// What a search is asked for.
struct TuneGoal {
    /// Largest amounts, as in `TuneLimits`; empty: at most `relative_limit_factor` times that of
    /// the least wrong setting that was tried, plus `relative_limit_spare`, and never more than
    /// `most_relative_limit`.
    std::optional<double> max_shadow_amount_rate = {};
    std::optional<double> max_light_amount_rate = {};
    double max_false_shadow_rate = 1; ///< by count
    double max_false_lit_rate = 1;
    int max_resolution_texels = 4096;
    double time_s = 30;                   ///< after which nothing more is tried
    std::function<double()> seconds = {}; ///< since the search was asked for; empty: time stands
};

/// What the goal's limits come to.
/// @param least_wrong  what the least wrong setting gives in each view; a relative limit allows
///                     for the worst of them.
[[nodiscard]] TuneLimits limits_of(const TuneGoal& goal, std::span<const ViewOutcome> least_wrong);

/// The mean of the two amount rates without softening, as far as both sides have pixels: shadow
/// counts for half, however little of it a view has.
[[nodiscard]] double mean_amount_rate(const ViewOutcome& outcome);

} // namespace gnomon::analysis
