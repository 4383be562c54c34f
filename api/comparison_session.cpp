#include "api/comparison_session.hpp"

#include "analysis/stopwatch.hpp"
#include "api/memory.hpp"
#include "methods/job_method.hpp"
#include "scene/job/file.hpp"

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
    : file_{analysis::timed(scene_s_, [&] { return load_checked(jobs); })},
      context_{options.device},
      scene_session_{context_, file_.scene, options}
{
}

} // namespace gnomon::api
