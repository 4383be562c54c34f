#include "cli/system/guarded_process.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace gnomon::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// The end of stderr that is kept [bytes].
constexpr std::size_t kept_errors = 4096;
/// The last bytes of stderr may arrive after the program has ended.
constexpr std::chrono::milliseconds last_errors_time{200};

Clock::time_point after(GuardedProcess::Seconds time)
{
    return Clock::now() + std::chrono::duration_cast<Clock::duration>(time);
}

int milliseconds_until(Clock::time_point until)
{
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count() + 1;
    return static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000));
}

void make_nonblocking(int descriptor)
{
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK);
}

/// Duplicates a descriptor above those that the guard's streams get: dup2 must not overwrite one
/// that is still to be passed.
int moved_up(int descriptor)
{
    const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, guard_socket + 1);
    require_call(moved >= 0 ? 0 : errno, "fcntl");
    return moved;
}

} // namespace

GuardedProcess::GuardedProcess(const std::vector<std::string>& command,
                               std::filesystem::path folder)
    : folder_{std::move(folder)}
{
    const std::filesystem::path work = folder_ / "work";
    std::error_code error;
    std::filesystem::create_directory(work, error);
    if (error) {
        throw scene::EnvironmentError(
            fmt::format("{}: the folder cannot be created: {}", work.string(), error.message()));
    }
    std::array<int, 2> sockets{};
    require_call(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) == 0 ? 0
                                                                                           : errno,
                 "socketpair");
    socket_ = sockets[0];
    std::vector<std::string> words{"gnomon", std::string{guard_word}, work.string()};
    words.insert(words.end(), command.begin(), command.end());
    std::array<int, 4> streams{moved_up(in_.reader()), moved_up(out_.writer()),
                               moved_up(err_.writer()), moved_up(sockets[1])};
    Launcher launcher;
    for (std::size_t i = 0; i < streams.size(); ++i) {
        launcher.pass(streams.at(i), static_cast<int>(i));
    }
    launcher.set_own_process_group(); // Ctrl+C must not reach it
    guard_ = launcher.start("/proc/self/exe", std::move(words));
    for (const int stream : streams) {
        ::close(stream);
    }
    ::close(sockets[1]);
    in_.close_reader();
    out_.close_writer();
    err_.close_writer();
    for (const int stream : {in_.writer(), out_.reader(), err_.reader()}) {
        make_nonblocking(stream);
    }
}

GuardedProcess::~GuardedProcess()
{
    ::close(socket_);
    while (::waitpid(guard_, nullptr, 0) < 0 && errno == EINTR) {
    }
    std::error_code error; // in case the guard was killed before it could
    std::filesystem::remove_all(folder_, error);
}

bool GuardedProcess::write_line(std::string_view text, Seconds longest)
{
    const auto until = after(longest);
    const std::string line = fmt::format("{}\n", text);
    std::string_view left = line;
    while (!left.empty()) {
        const ssize_t count = ::write(in_.writer(), left.data(), left.size());
        if (count > 0) {
            left.remove_prefix(static_cast<std::size_t>(count));
        } else if (errno == EAGAIN) {
            pollfd event{in_.writer(), POLLOUT, 0};
            if (::poll(&event, 1, milliseconds_until(until)) <= 0 && Clock::now() >= until) {
                return false;
            }
        } else if (errno != EINTR) {
            return true; // the program ended or closed its input; reading its answer will fail
        }
    }
    return true;
}

bool GuardedProcess::take(Clock::time_point until)
{
    std::array<pollfd, 2> streams{{{out_.reader(), POLLIN, 0}, {err_.reader(), POLLIN, 0}}};
    if (::poll(streams.data(), streams.size(), milliseconds_until(until)) <= 0) {
        return false;
    }
    if (streams[0].revents != 0 && !read_some(out_.reader(), output_)) {
        out_.close_reader(); // poll skips it
    }
    if (streams[1].revents != 0) {
        if (!read_some(err_.reader(), errors_)) {
            err_.close_reader();
        }
        if (errors_.size() > kept_errors) {
            errors_.erase(0, errors_.size() - kept_errors);
        }
    }
    return true;
}

std::optional<std::string> GuardedProcess::next_line()
{
    const std::size_t end = output_.find('\n');
    if (end == std::string::npos) {
        return std::nullopt;
    }
    std::string line = output_.substr(0, end);
    output_.erase(0, end + 1);
    return line;
}

AwaitedLine GuardedProcess::read_line(Seconds longest)
{
    using End = AwaitedLine::End;
    const auto until = after(longest);
    while (true) {
        if (auto line = next_line()) {
            return {End::line, std::move(*line)};
        }
        if (output_.size() > longest_line) {
            return {End::too_long, output_.substr(0, kept_errors)};
        }
        if (out_.reader() < 0) {
            return {End::ended, output_};
        }
        if (!take(until) && Clock::now() >= until) {
            return {End::timeout, output_};
        }
        if (Clock::now() >= until && output_.find('\n') == std::string::npos) {
            return {End::timeout, output_};
        }
    }
}

bool GuardedProcess::has_more()
{
    constexpr int tries = 16; // stderr may never fall silent
    for (int i = 0; i < tries && out_.reader() >= 0 && output_.empty(); ++i) {
        if (!take(Clock::now())) {
            break;
        }
    }
    return !output_.empty();
}

std::optional<int> GuardedProcess::wait(Seconds longest)
{
    const auto until = after(longest);
    while (!status_) {
        // Reads on, so that a full pipe does not keep the program from ending.
        std::array<pollfd, 3> events{
            {{socket_, POLLIN, 0}, {out_.reader(), POLLIN, 0}, {err_.reader(), POLLIN, 0}}};
        const int ready = ::poll(events.data(), events.size(), milliseconds_until(until));
        if (ready > 0 && events[0].revents != 0) {
            int status = 0;
            const ssize_t count = ::recv(socket_, &status, sizeof(status), MSG_WAITALL);
            // No status: the guard itself was killed.
            status_ = count == sizeof(status) ? status : 128 + SIGKILL;
        } else if (ready > 0) {
            (void)take(Clock::now());
            output_.resize(std::min(output_.size(), longest_line));
        }
        if (!status_ && Clock::now() >= until) {
            return std::nullopt;
        }
    }
    return status_;
}

std::string GuardedProcess::last_errors()
{
    const auto until = after(last_errors_time);
    while (err_.reader() >= 0 && Clock::now() < until && take(until)) {
        output_.resize(std::min(output_.size(), longest_line));
    }
    return errors_;
}

} // namespace gnomon::cli
