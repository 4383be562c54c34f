#include "api/tune.hpp"

#include "analysis/stopwatch.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <cstddef>

namespace gnomon::api {
namespace {

/// The limits of a search over methods, which has defaults for absolute limits that are not given.
analysis::TuneLimits limits_of_methods(const analysis::TuneGoal& goal)
{
    const analysis::TuneLimits usual;
    return {goal.max_shadow_amount_rate.value_or(usual.max_shadow_amount_rate),
            goal.max_light_amount_rate.value_or(usual.max_light_amount_rate),
            goal.max_false_shadow_rate, goal.max_false_lit_rate, goal.max_resolution_texels};
}

analysis::TuneResult tune_light(const ComparisonSession& session, const scene::LightJob& light,
                                const analysis::ViewRequest& request,
                                const analysis::TuneGoal& goal, const TuneRequest& wanted,
                                const TuneWatcher& watcher)
{
    const auto views =
        analysis::judge_views(light.job, session.file(), session.renderers(), request);
    if (wanted.methods) {
        return analysis::tune_methods(light.job, session.file(), session.renderers(), views,
                                      limits_of_methods(goal), *wanted.methods,
                                      watcher.methods ? watcher.methods(light.light)
                                                      : analysis::MethodProgress{});
    }
    const auto tell = [&](const analysis::TunedSetting& setting) {
        if (watcher.tried) {
            watcher.tried(light.light, setting);
        }
    };
    return analysis::tune(light.job, session.file(), session.renderers(), views, goal, tell);
}

} // namespace

void require_tunable(std::span<const scene::LightJob> jobs)
{
    for (const scene::LightJob& light : jobs) {
        if (!methods::traits(light.job).has_curve()) {
            throw scene::InputError(
                fmt::format("tune: method.name = \"{}\" has no bias curve, which tuning "
                            "needs; try its keys with `gnomon sweep`",
                            light.job.method.name));
        }
    }
}

std::vector<reports::TunedLight> tune(const ComparisonSession& session,
                                      std::span<const scene::LightJob> jobs,
                                      std::span<const analysis::ViewRequest> views,
                                      const TuneRequest& request, const TuneWatcher& watcher)
{
    std::vector<reports::TunedLight> lights;
    analysis::TuneGoal goal = request.goal;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (i > 0 || !goal.seconds) {
            goal.seconds = analysis::started_clock();
        }
        lights.push_back(
            {jobs[i].light, tune_light(session, jobs[i], views[i], goal, request, watcher)});
    }
    return lights;
}

} // namespace gnomon::api
