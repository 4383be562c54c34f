#include "analysis/tune/tuned_setting.hpp"

#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace gnomon::analysis {

namespace {

double error_of(const TunedSetting& setting)
{
    return mean_amount_rate(setting.bias.outcomes.front());
}

} // namespace

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

using scene::Job;

bool is_better(const TunedSetting& a, const TunedSetting& b)
{
    if (a.meets_limits() != b.meets_limits()) {
        return a.meets_limits();
    }
    const auto cost = [](const TunedSetting& setting) {
        return setting.meets_limits() ? setting.cost : LookupCost{};
    };
    const auto order = [&](const TunedSetting& setting) {
        // Failing settings were checked only in the job's own view.
        const ViewOutcome pooled =
            setting.meets_limits() ? setting.pooled() : setting.bias.outcomes.front();
        return std::tuple{cost(setting), mean_amount_rate(pooled),
                          pooled.metrics.error_rate.value_or(0), setting.cost,
                          -setting.bias.run.width()};
    };
    return order(a) < order(b);
}

Job tuned_job(const Job& job, const TunedSetting& setting)
{
    Job tuned = job;
    tuned.method = setting.method.value_or(job.method);
    tuned.shadow_map = setting.map;
    tuned.lookup.filter = setting.filter;
    tuned.bias = {.slope = setting.slope, .normal_texels = setting.normal_texels};
    if (!scene::has_key(tuned, "bias.constant")) {
        return tuned;
    }
    if (!setting.bias.outcomes.empty()) {
        const RoundedBias& found = setting.bias.rounded;
        scene::set_constant(tuned, *found.unit, found.value, double{setting.bias.constant()});
        return tuned;
    }
    // Cascades replace one map: their depth units differ, their metres do not.
    const bool has_new_cascades = setting.map.layout == scene::MapLayout::cascades &&
                                  scene::map_layout(job) != scene::MapLayout::cascades;
    scene::set_constant(
        tuned, has_new_cascades ? scene::bias_in_metres : scene::bias_unit_of(job.bias), 0, 0);
    return tuned;
}

void add_views(BiasSearch& search, const Job& job, const TunedSetting& setting,
               const CheckedViews& views, std::size_t count)
{
    const Job tuned = tuned_job(job, setting);
    for (std::size_t i = search.view_count(); i < count; ++i) {
        const CheckedView& judged = views.views[i];
        search.add_view(with_view_of(tuned, judged.view.job), judged);
    }
}

std::string why_nothing(const CheckedViews& views)
{
    const bool is_lit = std::ranges::any_of(views.views, [](const CheckedView& view) {
        return view.pixels.of(scene::PixelClass::lit) > 0;
    });
    if (is_lit) {
        return {};
    }
    const std::string where =
        views.views.size() == 1 ? "this view" : fmt::format("these {} views", views.views.size());
    return fmt::format("Nothing is recommended: no scored pixel of {} is lit, so acne cannot show "
                       "and any bias looks right. Aim the camera at lit surfaces.",
                       where);
}

bool TriedSettings::is_less_wrong(std::size_t a, std::size_t b) const
{
    return error_of(all_[a]) < error_of(all_[b]);
}

std::size_t TriedSettings::least_wrong(std::size_t first) const
{
    const auto begin = all_.begin() + static_cast<std::ptrdiff_t>(first);
    const auto least =
        std::min_element(begin, all_.end(), [](const TunedSetting& a, const TunedSetting& b) {
            return std::tuple{error_of(a), a.cost} < std::tuple{error_of(b), b.cost};
        });
    return static_cast<std::size_t>(least - all_.begin());
}

TuneLimits TriedSettings::limits() const
{
    if (all_.empty()) {
        return absolute_limits();
    }
    return limits_of(goal_, {&all_[least_wrong()].bias.outcomes.front(), 1});
}

TuneLimits TriedSettings::absolute_limits() const
{
    return {goal_.max_shadow_amount_rate.value_or(1), goal_.max_light_amount_rate.value_or(1),
            goal_.max_false_shadow_rate, goal_.max_false_lit_rate, goal_.max_resolution_texels};
}

std::optional<std::size_t> TriedSettings::cheapest_meeting(const TuneLimits& limits) const
{
    std::optional<std::size_t> best;
    const auto as_meeting = [&](std::size_t index) {
        TunedSetting setting = all_[index];
        setting.bias.meets_limits = true;
        return setting;
    };
    for (std::size_t i = 0; i < all_.size(); ++i) {
        if (meets_in_its_views(all_[i], limits) &&
            (!best || is_better(as_meeting(i), as_meeting(*best)))) {
            best = i;
        }
    }
    return best;
}

bool meets_in_its_views(const TunedSetting& setting, const TuneLimits& limits)
{
    return std::ranges::all_of(setting.bias.outcomes,
                               [&](const ViewOutcome& outcome) { return meets(outcome, limits); });
}

} // namespace gnomon::analysis
