#include "cli/system/guarded_process.hpp"

#include "cli/system/process_guard.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
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

/// So much of what is written to stderr is kept [bytes].
constexpr std::size_t kept_complaints = 4096;
/// What was written to stderr before the end arrives after it.
constexpr std::chrono::milliseconds last_words_time{200};

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

/// What the guard starts with.
class GuardSettings {
public:
    /// @param streams  what becomes its descriptors 0, 1, …
    explicit GuardSettings(const std::array<int, 4>& streams)
    {
        require_call(::posix_spawn_file_actions_init(&actions_), "posix_spawn_file_actions_init");
        ::posix_spawnattr_init(&attributes_);
        for (std::size_t i = 0; i < streams.size(); ++i) {
            ::posix_spawn_file_actions_adddup2(&actions_, streams.at(i), static_cast<int>(i));
        }
        ::posix_spawnattr_setpgroup(&attributes_, 0); // the terminal's signals are not for it
        ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP);
    }
    GuardSettings(const GuardSettings&) = delete;
    GuardSettings& operator=(const GuardSettings&) = delete;
    ~GuardSettings()
    {
        ::posix_spawnattr_destroy(&attributes_);
        ::posix_spawn_file_actions_destroy(&actions_);
    }

    [[nodiscard]] pid_t start(std::vector<std::string> words) const
    {
        std::vector<char*> arguments;
        for (std::string& word : words) {
            arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        pid_t guard = 0;
        require_call(::posix_spawn(&guard, "/proc/self/exe", &actions_, &attributes_,
                                   arguments.data(), environ),
                     "posix_spawn of the program itself");
        return guard;
    }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

/// Above the numbers that the guard's streams get, so that none replaces another too early.
int moved_up(int descriptor)
{
    const int moved = ::fcntl(descriptor, F_DUPFD_CLOEXEC, guard_socket + 1);
    require_call(moved >= 0 ? 0 : errno, "fcntl");
    return moved;
}

/// Adds what has arrived; false at the end.
bool take_some(int descriptor, std::string& text)
{
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
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
            fmt::format("{}: the folder cannot be made: {}", work.string(), error.message()));
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
    guard_ = GuardSettings{streams}.start(std::move(words));
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
    std::error_code error; // the guard did it, unless it was killed
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
            return true; // it has ended, or closed its input: what it answers will tell
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
    if (streams[0].revents != 0 && !take_some(out_.reader(), said_)) {
        out_.close_reader(); // poll skips it
    }
    if (streams[1].revents != 0) {
        if (!take_some(err_.reader(), complaints_)) {
            err_.close_reader();
        }
        if (complaints_.size() > kept_complaints) {
            complaints_.erase(0, complaints_.size() - kept_complaints);
        }
    }
    return true;
}

std::optional<std::string> GuardedProcess::next_line()
{
    const std::size_t end = said_.find('\n');
    if (end == std::string::npos) {
        return std::nullopt;
    }
    std::string line = said_.substr(0, end);
    said_.erase(0, end + 1);
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
        if (said_.size() > longest_line) {
            return {End::too_long, said_.substr(0, kept_complaints)};
        }
        if (out_.reader() < 0) {
            return {End::ended, said_};
        }
        if (!take(until) && Clock::now() >= until) {
            return {End::timeout, said_};
        }
        if (Clock::now() >= until && said_.find('\n') == std::string::npos) {
            return {End::timeout, said_};
        }
    }
}

bool GuardedProcess::has_more()
{
    constexpr int tries = 16; // complaints may come without end
    for (int i = 0; i < tries && out_.reader() >= 0 && said_.empty(); ++i) {
        if (!take(Clock::now())) {
            break;
        }
    }
    return !said_.empty();
}

std::optional<int> GuardedProcess::wait(Seconds longest)
{
    const auto until = after(longest);
    while (!status_) {
        // Whoever waits to write is not to wait for ever.
        std::array<pollfd, 3> events{
            {{socket_, POLLIN, 0}, {out_.reader(), POLLIN, 0}, {err_.reader(), POLLIN, 0}}};
        const int ready = ::poll(events.data(), events.size(), milliseconds_until(until));
        if (ready > 0 && events[0].revents != 0) {
            int status = 0;
            const ssize_t count = ::recv(socket_, &status, sizeof(status), MSG_WAITALL);
            // Without a word the guard itself was killed, and nobody knows.
            status_ = count == sizeof(status) ? status : 128 + SIGKILL;
        } else if (ready > 0) {
            (void)take(Clock::now());
            said_.resize(std::min(said_.size(), longest_line));
        }
        if (!status_ && Clock::now() >= until) {
            return std::nullopt;
        }
    }
    return status_;
}

std::string GuardedProcess::last_words()
{
    const auto until = after(last_words_time);
    while (err_.reader() >= 0 && Clock::now() < until && take(until)) {
        said_.resize(std::min(said_.size(), longest_line));
    }
    return complaints_;
}

} // namespace gnomon::cli
