#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/comparison.hpp"
#include "analysis/comparison/lookup_cost.hpp"
#include "analysis/renderers.hpp"
#include "analysis/tune/tune_goal.hpp"
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
    std::vector<std::string> keys; ///< what it changes of the one it was made from: "KEY = VALUE"
    std::string reason;            ///< one line
};

/// The setting of one method that is least wrong.
struct TunedMethod {
    std::string name;
    TunedSetting best;                   ///< looked at in every view
    std::vector<ViewOutcome> measured;   ///< GL's own, in every view
    std::size_t settings = 0;            ///< that were tried
    std::vector<RefusedSetting> refused; ///< what does not go together, or the driver lacks
    std::size_t index = 0;               ///< of `best` among those considered
};

/// What a search over methods found (`tune_methods`).
struct MethodRanking {
    std::uint64_t max_bytes = 0;     ///< of each one's maps
    std::size_t most_settings = 0;   ///< that could have been tried
    std::vector<TunedMethod> ranked; ///< the least wrong first; not empty
    std::vector<PassedOverMethod> passed_over;
};

struct TuneResult {
    /// Why nothing can be recommended, in one sentence: then nothing was tried.
    std::string nothing = {};
    std::vector<TunedSetting> considered; ///< in the order in which they were tried
    std::size_t recommended = 0;          ///< index; the one that is least wrong if none meets
    std::vector<AdviceView> views;        ///< that the limits hold in; the job's own first
    std::size_t passed_over = 0;          ///< generated views that showed too little
    TuneLimits limits = {};               ///< what the goal's limits came to
    int relative_limits = 0;     ///< how many of both amounts' came from the least wrong setting
    std::size_t least_wrong = 0; ///< index; what relative limits are made from
    bool is_cut_short = false;   ///< the time was up before all was tried
    double time_s = 0;           ///< that the search was given
    Comparison measured; ///< GL's own run with the recommended setting, in the job's own view
    std::vector<ViewOutcome> measured_views; ///< the same in every view
    std::optional<MethodRanking> methods;    ///< empty: the job's own alone was tried

    [[nodiscard]] const TunedSetting& best() const { return considered[recommended]; }
    [[nodiscard]] bool meets_limits() const { return nothing.empty() && best().meets_limits(); }
    /// The largest share of the blocked surface that is lit in a measured view.
    [[nodiscard]] double most_lit() const;
    /// Whether the best setting is worth using: it meets the limits, or lights at most half of the
    /// blocked surface.
    [[nodiscard]] bool recommends() const;
};

/// Searches resolution, depth format, fit, near and far, cascades, culling, filter, slope, normal
/// offset and constant bias for the cheapest setting within the limits.
///
/// The job's own setting comes first. Then each shape of the maps is tried at the largest size,
/// which tells what is possible, and what relative limits come to. From the two least wrong shapes
/// the search goes down: formats of fewer bytes first, then half the resolution, until none meets
/// the limits. At last other filters are tried with smaller maps than the cheapest. Constant biases
/// are not sampled where verdicts are no fractions: the bias curve knows the errors of every
/// float32. Other views are looked at for the cheapest settings alone: what fails in the job's own
/// fails.
/// @param file      The scene; must outlive the result, which points to its triangles.
/// @param views     The job's own first.
/// @param progress  told of each setting considered; may be empty.
/// @throws scene::InputError  as `compare` does, or if no resolution is left to try.
/// Source: docs/tune.md#the-search.
[[nodiscard]] TuneResult tune(const scene::Job& job, const scene::SceneFile& file,
                              const Renderers& renderers, const CheckedViews& views,
                              const TuneGoal& goal,
                              const std::function<void(const TunedSetting&)>& progress);

} // namespace gnomon::analysis
