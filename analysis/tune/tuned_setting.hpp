#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/checked_views.hpp"
#include "analysis/comparison/lookup_cost.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "scene/settings/filter.hpp"
#include "scene/settings/job.hpp"

#include <optional>
#include <string>

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
    scene::Keys keys = {};         ///< what the method's keys are; there where the method is
    bool sets_half_extent = false; ///< its map is fixed about what is in shadow

    [[nodiscard]] bool meets_limits() const { return bias.meets_limits; }
    [[nodiscard]] ViewOutcome pooled() const { return analysis::pooled(bias.outcomes); }
};

/// Whether a is to be recommended rather than b: it meets the limits; takes fewer bytes, then fewer
/// taps, if both do; is less wrong by the mean of the two amount rates, has fewer errors, or a
/// broader valley.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

/// Why no setting can be recommended for these views, in one sentence: where no scored pixel is
/// lit, no acne shows, and the least bias on the smallest map would look right.
/// @return  Empty if one can.
[[nodiscard]] std::string why_nothing(const CheckedViews& views);

/// The job with a setting's keys in place of its own.
[[nodiscard]] scene::Job tuned_job(const scene::Job& job, const TunedSetting& setting);

} // namespace gnomon::analysis
