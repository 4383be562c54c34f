#include "cli/system/slow_work.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <functional>
#include <utility>

namespace gnomon::cli {
namespace {

constexpr std::chrono::seconds patience{2};
constexpr std::chrono::seconds live_interval{1};
constexpr std::chrono::seconds log_interval{30};

template <typename Result, typename... Arguments>
std::function<Result(Arguments...)> announced_stage(std::function<Result(Arguments...)> stage,
                                                    SlowWork& work, const char* what)
{
    if (!stage) {
        return stage;
    }
    return [stage = std::move(stage), &work, what](Arguments... arguments) {
        work.now(what);
        return stage(std::forward<Arguments>(arguments)...);
    };
}

} // namespace

SlowWork::SlowWork(std::string what)
    : is_terminal_{::isatty(STDERR_FILENO) == 1},
      what_{std::move(what)},
      watcher_{[this] { watch(); }}
{
}

SlowWork::~SlowWork()
{
    {
        const std::lock_guard lock{mutex_};
        is_done_ = true;
    }
    changed_.notify_all();
    watcher_.join();
    if (has_line_) {
        std::fputs("\r\x1b[K", stderr);
    }
}

void SlowWork::now(std::string what)
{
    const std::lock_guard lock{mutex_};
    what_ = std::move(what);
}

void SlowWork::watch()
{
    std::unique_lock lock{mutex_};
    const auto ends_within = [&](std::chrono::seconds time) {
        return changed_.wait_for(lock, time, [this] { return is_done_; });
    };
    if (ends_within(is_terminal_ ? patience : log_interval)) {
        return;
    }
    do {
        tell();
    } while (!ends_within(is_terminal_ ? live_interval : log_interval));
}

void SlowWork::tell()
{
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - start_).count();
    if (is_terminal_) {
        fmt::print(stderr, "\r\x1b[Kgnomon: {} s: {}", seconds, what_);
        has_line_ = true;
    } else {
        fmt::print(stderr, "gnomon: {} s: {}\n", seconds, what_);
    }
    std::fflush(stderr);
}

analysis::Renderers announced(analysis::Renderers renderers, SlowWork& work)
{
    renderers.draw_receivers =
        announced_stage(std::move(renderers.draw_receivers), work, "drawing what the camera sees");
    renderers.draw_shadow_map =
        announced_stage(std::move(renderers.draw_shadow_map), work, "drawing the shadow map");
    renderers.look_up =
        announced_stage(std::move(renderers.look_up), work, "looking the shadows up");
    renderers.find_critical_biases = announced_stage(std::move(renderers.find_critical_biases),
                                                     work, "finding the bias curve by bisection");
    renderers.find_truth =
        announced_stage(std::move(renderers.find_truth), work, "tracing the true shadows");
    renderers.make_exact_light = announced_stage(std::move(renderers.make_exact_light), work,
                                                 "finding causes and the bias curve");
    return renderers;
}

} // namespace gnomon::cli
