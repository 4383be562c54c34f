#include "api/compare.hpp"

#include "analysis/sweep/compare.hpp"
#include "reference_rt/truth.hpp"

#include <cstddef>
#include <utility>

namespace gnomon::api {

std::vector<analysis::Comparison> compare(const ComparisonSession& session,
                                          std::span<const scene::LightJob> jobs,
                                          const CompareHooks& hooks)
{
    std::vector<scene::Job> of_lights;
    for (const scene::LightJob& light : jobs) {
        of_lights.push_back(light.job);
    }
    std::vector<analysis::Comparison> comparisons(jobs.size());
    const auto take = [&](std::size_t light, analysis::Comparison&& comparison) {
        comparison.light = jobs[light].light;
        comparison.seconds.scene += session.scene_seconds();
        comparison.seconds.bvh = session.bvh_seconds();
        if (hooks.finish) {
            hooks.finish(comparison);
        }
        comparisons[light] = std::move(comparison);
    };
    analysis::compare_each(of_lights, session.file(),
                           hooks.renderers != nullptr ? *hooks.renderers : session.renderers(),
                           take);
    return comparisons;
}

scene::Image<scene::Vec3f> points_of(const analysis::Comparison& comparison)
{
    return comparison.evaluation
               ? comparison.evaluation->points
               : reference_rt::receiver_points(*comparison.triangles, comparison.view,
                                               comparison.receivers.triangle);
}

} // namespace gnomon::api
