#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/judged_views.hpp"
#include "analysis/advice/lookup_cost.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"
#include "analysis/tune/tune_space.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// One setting that was considered, with the constant bias that is recommended for it.
struct TunedSetting {
    scene::ShadowMapSettings map;
    scene::Filter filter = scene::Filter::nearest;
    double slope = 0;
    double normal_texels = 0;
    LookupCost cost;
    bool has_filter = true; ///< else the job's method has none, and `filter` says nothing
    FoundBias bias; ///< its outcomes are of the job's own view alone where that fails the limits
    /// With its keys and those of its bias terms; empty: the job's own.
    std::optional<scene::MethodSettings> method = {};

    [[nodiscard]] bool meets_limits() const { return bias.meets_limits; }
    [[nodiscard]] ViewOutcome pooled() const { return analysis::pooled(bias.outcomes); }
};

/// Whether a is to be recommended rather than b: it meets the limits; takes fewer bytes, then fewer
/// taps, if both do; is less wrong by amount per scored pixel, has fewer errors, or a broader
/// valley.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

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
    std::vector<TunedSetting> considered; ///< in the order in which they were tried
    std::size_t recommended = 0;          ///< index; the one that is least wrong if none meets
    std::vector<AdviceView> views;        ///< that the limits hold in; the job's own first
    std::size_t passed_over = 0;          ///< generated views that showed too little
    /// Maps with which other culling and filters were not tried, for errors were far above the
    /// limits.
    std::vector<MapSize> hopeless;
    Comparison measured; ///< GL's own run with the recommended setting, in the job's own view
    std::vector<ViewOutcome> measured_views; ///< the same in every view
    std::optional<MethodRanking> methods;    ///< empty: the job's own alone was tried

    [[nodiscard]] const TunedSetting& best() const { return considered[recommended]; }
    [[nodiscard]] bool meets_limits() const { return best().meets_limits(); }
};

/// The job with a setting's keys in place of its own.
[[nodiscard]] scene::Job tuned_job(const scene::Job& job, const TunedSetting& setting);

/// Searches resolution, depth format, fit, near and far, culling, filter, slope, normal offset and
/// constant bias.
///
/// Maps are tried from the fewest bytes upwards, filters from the fewest taps, and the search ends
/// with the first bytes and taps at which a setting meets the limits in every view. Of those it is
/// the one that is least wrong. Other views are looked at only for settings that meet the limits in
/// the job's own: what fails there fails. Constant biases are not sampled where verdicts are no
/// fractions: the bias curve knows the errors of every float32.
/// @param file      The scene; must outlive the result, which points to its triangles.
/// @param views     The job's own first.
/// @param progress  told of each setting considered; may be empty.
/// @throws scene::InputError  as `compare` does, or if no resolution is left to try.
[[nodiscard]] TuneResult tune(const scene::Job& job, const scene::SceneFile& file,
                              const Renderers& renderers, const JudgedViews& views,
                              const TuneLimits& limits,
                              const std::function<void(const TunedSetting&)>& progress);

} // namespace gnomon::analysis
