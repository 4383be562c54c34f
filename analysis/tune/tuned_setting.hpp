#pragma once

#include "analysis/advice/bias_search.hpp"
#include "analysis/advice/checked_views.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/comparison/view_outcome.hpp"
#include "scene/settings/filter.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// How far each amount rate may exceed that of the least wrong setting if no limit is given.
inline constexpr double relative_limit_factor = 1.25;
inline constexpr double relative_limit_spare = 0.0002;
/// A setting that loses half the shadow is useless.
inline constexpr double most_relative_limit = 0.5;

/// The goal of a search.
struct TuneGoal {
    /// Largest amounts, as in `TuneLimits`; empty: `relative_limit_factor` times that of the least
    /// wrong setting tried, plus `relative_limit_spare`, at most `most_relative_limit`.
    std::optional<double> max_shadow_amount_rate = {};
    std::optional<double> max_light_amount_rate = {};
    double max_false_shadow_rate = 1; ///< by count
    double max_false_lit_rate = 1;
    int max_resolution_texels = 4096;
    double time_s = 30;                   ///< after which nothing more is tried
    std::function<double()> seconds = {}; ///< since the request; empty: no time passes
};

/// The goal's limits as numbers.
/// @param least_wrong  The least wrong setting's outcome in each view; a relative limit allows for
///                     the worst of them.
[[nodiscard]] TuneLimits limits_of(const TuneGoal& goal, std::span<const ViewOutcome> least_wrong);

/// The mean of the two amount rates without softening, of those that exist: shadow counts half,
/// however little of it a view has.
[[nodiscard]] double mean_amount_rate(const ViewOutcome& outcome);

/// A setting that was considered, with its recommended constant bias.
struct TunedSetting {
    scene::ShadowMapSettings map;
    scene::Filter filter = scene::Filter::nearest;
    double slope = 0;
    double normal_texels = 0;
    LookupCost cost;
    bool has_filter = true; ///< else the job's method has none, and `filter` is ignored
    FoundBias bias;         ///< outcomes in the job's own view alone if that fails the limits
    /// With the keys of the method and its bias terms; empty: the job's own.
    std::optional<scene::MethodSettings> method = {};
    scene::Keys keys = {};         ///< definitions of the method's keys; set if `method` is
    bool sets_half_extent = false; ///< its map is fixed around the shadowed receivers

    [[nodiscard]] bool meets_limits() const { return bias.meets_limits; }
    [[nodiscard]] ViewOutcome pooled() const { return analysis::pooled(bias.outcomes); }
};

/// Whether to recommend a rather than b. The first difference decides: limits met; bytes, then
/// taps, if both meet them; mean of the two amount rates; errors by count; bytes and taps; width of
/// the valley.
[[nodiscard]] bool is_better(const TunedSetting& a, const TunedSetting& b);

/// Why no setting can be recommended for these views, in one sentence: if no scored pixel is lit,
/// no acne shows, and the least bias on the smallest map would look right.
/// @return  Empty if one can.
[[nodiscard]] std::string why_nothing(const CheckedViews& views);

/// The job with a setting's keys in place of its own.
[[nodiscard]] scene::Job tuned_job(const scene::Job& job, const TunedSetting& setting);

/// Adds views to a search until it has `count` of them, each with the setting's job.
void add_views(BiasSearch& search, const scene::Job& job, const TunedSetting& setting,
               const CheckedViews& views, std::size_t count);

/// The settings that a search has tried, and the best of them. Errors are those in the job's own
/// view.
class TriedSettings {
public:
    /// @param goal  Must outlive this.
    explicit TriedSettings(const TuneGoal& goal) : goal_{goal} {}

    void add(TunedSetting setting) { all_.push_back(std::move(setting)); }
    [[nodiscard]] bool empty() const { return all_.empty(); }
    [[nodiscard]] std::size_t size() const { return all_.size(); }
    [[nodiscard]] const TunedSetting& operator[](std::size_t index) const { return all_[index]; }
    [[nodiscard]] TunedSetting& operator[](std::size_t index) { return all_[index]; }
    [[nodiscard]] std::vector<TunedSetting> take() { return std::move(all_); }

    /// Whether the mean of a's amount rates is below that of b.
    [[nodiscard]] bool is_less_wrong(std::size_t a, std::size_t b) const;
    /// The index of the least wrong from `first` on, of equals the cheapest. There must be one.
    [[nodiscard]] std::size_t least_wrong(std::size_t first = 0) const;
    /// The goal's limits as numbers, as far as is known.
    [[nodiscard]] TuneLimits limits() const;
    /// The limits without relative ones; the recommended bias shows what is possible.
    [[nodiscard]] TuneLimits absolute_limits() const;
    /// The best that meets the limits in all views in which it was checked.
    [[nodiscard]] std::optional<std::size_t> cheapest_meeting(const TuneLimits& limits) const;

private:
    const TuneGoal& goal_;
    std::vector<TunedSetting> all_; ///< in the order of the trials
};

/// Whether the setting meets the limits in every view in which it was checked.
[[nodiscard]] bool meets_in_its_views(const TunedSetting& setting, const TuneLimits& limits);

} // namespace gnomon::analysis
