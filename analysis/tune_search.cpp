#include "analysis/tune_search.hpp"

#include "analysis/bias_reruns.hpp"
#include "analysis/lookup/deciding_samples.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

/// The largest count whose rate does not exceed the limit.
std::uint64_t allowed(double max_rate, std::uint64_t denominator)
{
    const auto whole = static_cast<double>(denominator);
    auto count = static_cast<std::uint64_t>(std::clamp(max_rate, 0.0, 1.0) * whole);
    // The product rounds, and rates are quotients: the quotient decides.
    while (count < denominator && static_cast<double>(count + 1) / whole <= max_rate) {
        ++count;
    }
    while (count > 0 && static_cast<double>(count) / whole > max_rate) {
        --count;
    }
    return count;
}

bool meets(const std::optional<double>& rate, double limit)
{
    return !rate || *rate <= limit;
}

bool meets(const TunedSetting& setting, const TuneLimits& limits)
{
    return meets(setting.false_shadow_rate, limits.max_false_shadow_rate) &&
           meets(setting.false_lit_rate, limits.max_false_lit_rate);
}

/// Where biases are looked for: a recommendation does not push surfaces towards the light.
constexpr BiasInterval usable_biases{0.0F, 1.0F};

} // namespace

BiasSearch::BiasSearch(const scene::Job& job, const scene::View& view,
                       const scene::TruthLayers& truth, const Renderers& renderers)
    : job_{job},
      view_{view},
      truth_{truth},
      renderers_{renderers}
{
    const scene::FilterPromises& promised = scene::promises(job.lookup.filter);
    if (!promised.has_curve()) {
        return;
    }
    const scene::LookupLayers lookup = renderers.look_up(job, view);
    const auto depths =
        promised.returns_deciding_depth() ? scene::Image<float>{} : renderers.read_map_depths();
    deciding_ = deciding_samples(lookup, lookup.texels, depths, lookup_rule(job, view));
}

void BiasSearch::find_constant(const TuneLimits& limits, TunedSetting& setting) const
{
    if (deciding_.samples.empty()) {
        search_by_rendering(limits, setting);
    } else {
        search_curve(limits, setting);
    }
}

void BiasSearch::search_curve(const TuneLimits& limits, TunedSetting& setting) const
{
    LookupRule rule = lookup_rule(job_, view_);
    rule.slope = static_cast<float>(setting.slope);
    const BiasCurve curve{critical_biases(deciding_, rule), truth_.pixel_class};
    const ErrorCounts most{allowed(limits.max_false_shadow_rate, curve.lit().size()),
                           allowed(limits.max_false_lit_rate, curve.blocked().size())};
    BiasInterval within = usable_biases;
    if (const auto meeting = biases_with_at_most(curve, most)) {
        const BiasInterval both{std::max(meeting->lo, usable_biases.lo),
                                std::min(meeting->hi, usable_biases.hi)};
        setting.meets_limits = both.lo <= both.hi;
        within = setting.meets_limits ? both : usable_biases;
    }
    const BestBiases best = find_best_biases(curve, within);
    setting.interval = best.interval;
    setting.constant = best.recommended();
    setting.errors = curve.at(setting.constant);
    setting.false_shadow_rate = curve.false_shadow_rate(setting.errors);
    setting.false_lit_rate = curve.false_lit_rate(setting.errors);
    setting.error_rate = curve.error_rate(setting.errors);
}

void BiasSearch::search_by_rendering(const TuneLimits& limits, TunedSetting& setting) const
{
    scene::View view = view_;
    view.bias.slope = static_cast<float>(setting.slope);
    bool is_first = true;
    for (const BiasRerun& rerun : rerun_biases(job_, view, truth_, renderers_)) {
        TunedSetting tried = setting;
        tried.constant = rerun.bias;
        tried.interval = {rerun.bias, rerun.bias};
        tried.errors = rerun.errors;
        tried.false_shadow_rate = rerun.false_shadow_rate;
        tried.false_lit_rate = rerun.false_lit_rate;
        tried.error_rate = rerun.error_rate;
        tried.meets_limits = meets(tried, limits);
        const bool is_better = tried.meets_limits != setting.meets_limits
                                   ? tried.meets_limits
                                   : tried.errors.total() < setting.errors.total();
        if (is_first || is_better) {
            setting = tried;
            is_first = false;
        }
    }
}

} // namespace gnomon::analysis
