#include "analysis/tune/tuned_setting.hpp"

#include "analysis/tune/tune_goal.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace gnomon::analysis {

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
        // What fails was not looked at in all views: the job's own tells them apart.
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
    // Cascades in place of one map: their depth units differ, their metres do not.
    const bool has_new_cascades = setting.map.layout == scene::MapLayout::cascades &&
                                  scene::map_layout(job) != scene::MapLayout::cascades;
    scene::set_constant(
        tuned, has_new_cascades ? scene::bias_in_metres : scene::bias_unit_of(job.bias), 0, 0);
    return tuned;
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

} // namespace gnomon::analysis
