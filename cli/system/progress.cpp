#include "cli/system/progress.hpp"

#include "reports/text/text.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace gnomon::cli {
namespace {

constexpr std::chrono::milliseconds terminal_interval{100};
constexpr std::chrono::seconds pipe_interval{5};

/// The terminal's columns. A longer line would wrap, and its first part would not be erased.
std::size_t terminal_columns()
{
    winsize size{};
    const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return is_known ? size.ws_col - 1U : 79U;
}

/// "1:02:03", "2:03".
std::string clock_text(double seconds)
{
    const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
    const std::uint64_t hours = whole / 3600;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, whole / 60 % 60, whole % 60)
                     : fmt::format("{}:{:02}", whole / 60, whole % 60);
}

} // namespace

Progress::Progress(std::uint64_t total, std::uint64_t known, bool is_quiet)
    : total_{total},
      known_{known},
      is_quiet_{is_quiet},
      is_terminal_{::isatty(STDERR_FILENO) == 1}
{
}

Progress::~Progress()
{
    if (has_line_ && is_terminal_) {
        std::fputs("\n", stderr);
    }
}

void Progress::begin(const std::string& configuration)
{
    const std::lock_guard lock{mutex_};
    current_ = scene::one_line(configuration);
    tell(false);
}

void Progress::add(std::uint64_t done, std::uint64_t failed)
{
    const std::lock_guard lock{mutex_};
    done_ += done;
    failed_ += failed;
    tell(done_ + failed_ == total_);
}

std::string Progress::line() const
{
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    const std::uint64_t told = done_ + failed_;
    std::string text = fmt::format("{}/{} done", reports::grouped(known_ + done_),
                                   reports::grouped(known_ + total_));
    if (failed_ > 0) {
        text += fmt::format(", {} failed", reports::grouped(failed_));
    }
    if (told > 0 && elapsed > 0) {
        const double rate = static_cast<double>(told) / elapsed;
        text += fmt::format(", {}/s, {} left", reports::grouped_amount(rate),
                            clock_text(static_cast<double>(total_ - told) / rate));
    }
    if (told < total_ && !current_.empty()) {
        text += ": ";
        text += current_;
    }
    return text;
}

void Progress::tell(bool is_forced)
{
    const auto now = Clock::now();
    const auto interval =
        is_terminal_ ? Clock::duration{terminal_interval} : Clock::duration{pipe_interval};
    if (is_quiet_ || (!is_forced && has_line_ && now - told_ < interval)) {
        return;
    }
    told_ = now;
    has_line_ = true;
    const std::string text = line();
    if (is_terminal_) {
        const std::size_t columns = terminal_columns();
        fmt::print(stderr, "\r\x1b[K{}", reports::first_columns(text, columns));
    } else {
        fmt::print(stderr, "gnomon sweep: {}\n", text);
    }
    std::fflush(stderr);
}

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
