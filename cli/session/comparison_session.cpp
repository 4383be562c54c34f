#include "cli/session/comparison_session.hpp"

#include "cli/system/memory.hpp"
#include "cli/system/stopwatch.hpp"
#include "methods/job_method.hpp"
#include "scene/job/file.hpp"

#include <CLI/CLI.hpp>

namespace gnomon::cli {

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
    : file_{timed(scene_s_, [&] { return load_checked(jobs); })},
      context_{options.device},
      scene_session_{context_, file_.scene, options}
{
}

void add_session_options(CLI::App& command, SessionOptions& options)
{
    command.add_option(
        "--device", options.device,
        "EGL device, as `gnomon doctor` numbers them; default: the first that works");
    command.add_option("--threads", options.threads, "Threads of the reference; 0: all cores")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
}

} // namespace gnomon::cli
