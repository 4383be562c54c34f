#include "api/compare.hpp"

#include "analysis/stopwatch.hpp"
#include "analysis/sweep/compare.hpp"
#include "api/memory.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "reference_rt/truth.hpp"
#include "reports/json/comparison_json.hpp"
#include "scene/job/file.hpp"
#include "store/exr/aov.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/pixels.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace gnomon::api {

namespace {

scene::SceneFile load_checked(std::span<const scene::LightJob> jobs)
{
    require_memory(jobs);
    return scene::load_scene(jobs.front().job.scene, methods::vertex_normals(jobs));
}

} // namespace

ComparisonSession::ComparisonSession(const scene::Job& job, const SessionOptions& options)
    : ComparisonSession{std::array{scene::LightJob{{}, job}}, options}
{
}

ComparisonSession::ComparisonSession(std::span<const scene::LightJob> jobs,
                                     const SessionOptions& options)
    : ComparisonSession{[&] { return load_checked(jobs); }, options}
{
}

ComparisonSession::ComparisonSession(scene::SceneFile scene, std::span<const scene::LightJob> jobs,
                                     const SessionOptions& options)
    : ComparisonSession{[&] {
                            require_memory(jobs);
                            return scene::complete_scene(std::move(scene), jobs.front().job.scene,
                                                         methods::vertex_normals(jobs));
                        },
                        options}
{
}

ComparisonSession::ComparisonSession(const std::function<scene::SceneFile()>& load,
                                     const SessionOptions& options)
    : options_{options},
      file_{std::make_shared<const scene::SceneFile>(analysis::timed(scene_s_, load))},
      context_{opened(options)},
      loaded_scene_{*context_, file_->scene, options}
{
}

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

namespace {

/// Read once: a sweep may keep the pixels of thousands of configurations.
const std::vector<reports::SettingsTarget>& settings_targets()
{
    static const std::vector<reports::SettingsTarget> all =
        reports::settings_targets(*methods::key_table());
    return all;
}

} // namespace

void keep_pixels(const std::filesystem::path& folder, std::string_view id,
                 const analysis::Comparison& comparison)
{
    const auto points = points_of(comparison);
    store::make_pixels_folder(folder);
    // Written last, so that an image always has its JSON file.
    store::write_file(store::detail_path(folder, id),
                      reports::kept_json(comparison, settings_targets()));
    store::write_aov(store::pixels_path(folder, id), comparison, points);
}

} // namespace gnomon::api
