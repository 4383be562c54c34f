#include "api/comparison_session.hpp"

#include "analysis/stopwatch.hpp"
#include "api/memory.hpp"
#include "methods/job_method.hpp"
#include "scene/job/file.hpp"

#include <utility>

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
      scene_session_{*context_, file_->scene, options}
{
}

} // namespace gnomon::api
