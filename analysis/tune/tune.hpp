#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/judged_views.hpp"
#include "analysis/advice/lookup_cost.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison.hpp"
#include "analysis/renderers.hpp"
#include "analysis/tune/tune_space.hpp"

#include <cstddef>
#include <functional>
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

    [[nodiscard]] bool meets_limits() const { return bias.meets_limits; }
    [[nodiscard]] ViewOutcome pooled() const { return analysis::pooled(bias.outcomes); }
};

/// Whether a is to be recommended rather than b: it meets the limits; takes fewer bytes, then fewer
/// taps, if both do; is less wrong by amount per scored pixel, has fewer errors, or a broader
/// valley.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

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
