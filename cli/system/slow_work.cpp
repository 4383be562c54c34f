#include "cli/system/slow_work.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace gnomon::cli {
namespace {

constexpr std::chrono::seconds patience{2};
constexpr std::chrono::seconds live_interval{1};
constexpr std::chrono::seconds log_interval{30};

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

} // namespace gnomon::cli
