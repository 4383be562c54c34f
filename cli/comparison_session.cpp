#include "cli/comparison_session.hpp"

#include "cli/memory.hpp"

#include <chrono>

namespace gnomon::cli {

namespace {

/// Runs `work` and adds its wall time to `seconds`.
template <typename Work>
auto timed(double& seconds, const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

scene::SceneFile load_checked(const scene::Job& job)
{
    require_memory(job);
    return scene::load_scene(job.scene);
}

} // namespace

ComparisonSession::ComparisonSession(const scene::Job& job, const SessionOptions& options)
    : file_{timed(scene_s_, [&] { return load_checked(job); })},
      context_{options.device},
      gl_{context_, file_.scene}
{
    const bool is_exact = options.method == reference_rt::TruthMethod::exact;
    reference_ = timed(bvh_s_, [&] {
        return std::make_unique<reference_rt::ReferenceScene>(
            file_.scene,
            reference_rt::ReferenceOptions{options.threads, is_exact, !is_exact || options.audits});
    });
    renderers_ =
        make_renderers(gl_, context_.facts(), *reference_, {options.method, options.threads});
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
