#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/renderers.hpp"
#include "analysis/tune/tuned_setting.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A setting that could not be tried.
struct RefusedSetting {
    std::vector<std::string> keys; ///< changes to the setting it was made from: "KEY = VALUE"
    std::string reason;            ///< one line
};

/// The least wrong setting of one method.
struct TunedMethod {
    std::string name;
    TunedSetting best;                   ///< checked in every view
    std::vector<ViewOutcome> measured;   ///< GL's outcome in every view
    std::size_t settings = 0;            ///< number of settings tried
    std::vector<RefusedSetting> refused; ///< contradictory, or beyond the driver
    std::size_t index = 0;               ///< of `best` among those considered
};

/// The result of a search over methods (`tune_methods`).
struct MethodRanking {
    std::uint64_t max_bytes = 0;     ///< for each method's maps
    std::size_t most_settings = 0;   ///< number that could have been tried
    std::vector<TunedMethod> ranked; ///< the least wrong first; not empty
    std::vector<PassedOverMethod> passed_over;
};

struct TuneResult {
    /// Why nothing can be recommended, in one sentence; then nothing was tried.
    std::string nothing = {};
    std::vector<TunedSetting> considered; ///< in the order of the trials
    std::size_t recommended = 0;          ///< index; the least wrong if none meets the limits
    std::vector<AdviceView> views;        ///< in which the limits apply; the job's own first
    std::size_t passed_over = 0;          ///< generated views that showed too little
    TuneLimits limits = {};               ///< the goal's limits as numbers
    int relative_limits = 0;              ///< how many of the two amount limits are relative ones
    std::size_t least_wrong = 0;          ///< index; the base of relative limits
    bool is_cut_short = false;            ///< time ran out before all was tried
    double time_s = 0;                    ///< for the search
    Comparison measured; ///< GL's run with the recommended setting, in the job's own view
    std::vector<ViewOutcome> measured_views; ///< GL's runs in every view
    std::optional<MethodRanking> methods;    ///< empty: only the job's own was tried

    [[nodiscard]] const TunedSetting& best() const { return considered[recommended]; }
    [[nodiscard]] bool meets_limits() const { return nothing.empty() && best().meets_limits(); }
    /// The largest lit share of the blocked surface in a measured view.
    [[nodiscard]] double most_lit() const;
    /// Whether the best setting is worth using: it meets the limits, or lights at most half of the
    /// blocked surface.
    [[nodiscard]] bool recommends() const;
};

/// Searches resolution, depth format, fit, near and far, cascades, culling, filter, slope, normal
/// offset and constant bias for the cheapest setting within the limits.
///
/// It tries the job's own setting first. Then it tries each shape of the maps at the largest size,
/// which shows what is possible and fixes relative limits. From the two least wrong shapes it goes
/// down: formats of fewer bytes first, then half the resolution, until none meets the limits.
/// Finally it tries other filters with smaller maps than the cheapest. If verdicts are not
/// fractions, constant biases are not sampled: the bias curve knows the errors of every float32.
/// Only the cheapest settings are checked in other views, because a failure in the job's own view
/// is final.
/// @param file      The scene; must outlive the result, which points to its triangles.
/// @param views     The job's own first.
/// @param progress  Called for each setting considered; may be empty.
/// @throws scene::InputError  As `compare` does, or if no resolution is left to try.
/// Source: docs/tune.md#the-search.
[[nodiscard]] TuneResult tune(const scene::Job& job, const scene::SceneFile& file,
                              const Renderers& renderers, const CheckedViews& views,
                              const TuneGoal& goal,
                              const std::function<void(const TunedSetting&)>& progress);

} // namespace gnomon::analysis
