#include "analysis/sweep/compare.hpp"

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Throws the failure that a sweep would record.
[[noreturn]] void fail(const std::string& message, Retry retry)
{
    if (retry == Retry::is_useless) {
        throw scene::InputError{message};
    }
    throw scene::EnvironmentError{message};
}

} // namespace

void compare_each(std::span<const scene::Job> jobs, const scene::SceneFile& file,
                  const Renderers& renderers, const TakeComparison& take)
{
    std::vector<CurveRequest> requests;
    for (const scene::Job& job : jobs) {
        const scene::Job laid_out = scene::with_layout(job, file.defaults);
        methods::check(laid_out);
        (void)scene::resolve_view(laid_out, file.scene, file.defaults); // throws before any work
        requests.push_back({.keys = stage_keys_with_bias(laid_out), .ordinals = {requests.size()}});
    }
    SweepHooks hooks;
    hooks.open_scene = [&](const scene::Job&) { return OpenScene{&file, &renderers}; };
    hooks.task = [&](std::size_t curve) {
        return SweepTask{std::to_string(curve), jobs[curve], {{curve, jobs[curve].bias}}};
    };
    hooks.record_failure = [](std::span<const std::uint64_t>, const std::string& message,
                              Retry retry) { fail(message, retry); };
    hooks.keep_pixels = take;
    run_sweep(make_plan(requests, 1), hooks);
}

Comparison compare(const scene::Job& job, const scene::SceneFile& file, const Renderers& renderers)
{
    std::optional<Comparison> result;
    compare_each({&job, 1}, file, renderers,
                 [&](std::size_t, Comparison&& comparison) { result = std::move(comparison); });
    return std::move(*result);
}

} // namespace gnomon::analysis
