#include "cli/system/captured_process.hpp"

#include "cli/system/pipe.hpp"
#include "cli/system/process.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace gnomon::cli {
namespace {

/// What the child starts with: its streams, and the signals that gnomon ignores as they were.
class SpawnSettings {
public:
    SpawnSettings(const Pipe& out, const Pipe& err)
    {
        require_call(::posix_spawn_file_actions_init(&actions_), "posix_spawn_file_actions_init");
        ::posix_spawnattr_init(&attributes_);
        ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        ::posix_spawn_file_actions_adddup2(&actions_, out.writer(), STDOUT_FILENO);
        ::posix_spawn_file_actions_adddup2(&actions_, err.writer(), STDERR_FILENO);
        sigset_t ignored{};
        ::sigemptyset(&ignored);
        ::sigaddset(&ignored, SIGPIPE);
        ::sigaddset(&ignored, SIGXFSZ);
        ::posix_spawnattr_setsigdefault(&attributes_, &ignored);
        ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
    ~SpawnSettings()
    {
        ::posix_spawnattr_destroy(&attributes_);
        ::posix_spawn_file_actions_destroy(&actions_);
    }

    [[nodiscard]] pid_t start(const std::vector<std::string>& command) const
    {
        std::vector<char*> arguments;
        for (const std::string& argument : command) {
            arguments.push_back(const_cast<char*>(argument.c_str()));
        }
        arguments.push_back(nullptr);
        pid_t child = 0;
        const int code = ::posix_spawn(&child, arguments.front(), &actions_, &attributes_,
                                       arguments.data(), environ);
        if (code != 0) {
            throw scene::EnvironmentError(
                fmt::format("{}: cannot be run: {}", command.front(), std::strerror(code)));
        }
        return child;
    }

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
};

/// Adds what has arrived; false at the end.
bool take(int descriptor, std::string& text)
{
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return count > 0 || (count < 0 && errno == EINTR);
}

/// Both streams at once, as a child that fills one waits until somebody reads it.
void read_all(const Pipe& out, const Pipe& err, CapturedEnding& ending)
{
    std::array<pollfd, 2> streams{{{out.reader(), POLLIN, 0}, {err.reader(), POLLIN, 0}}};
    const std::array<std::string*, 2> texts{&ending.out, &ending.err};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        if (::poll(streams.data(), streams.size(), -1) < 0) {
            if (errno == EINTR) {
                continue;
            }
            require_call(errno, "poll");
        }
        for (std::size_t i = 0; i < streams.size(); ++i) {
            if (streams[i].revents != 0 && !take(streams[i].fd, *texts[i])) {
                streams[i].fd = -1; // poll skips it
            }
        }
    }
}

int wait_for(pid_t child)
{
    siginfo_t state{};
    // The id stays the child's until it is reaped: a signal handler may kill it up to here.
    while (::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOWAIT) < 0 &&
           errno == EINTR) {
    }
    end_with_this_process(0);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

} // namespace

CapturedEnding run_captured(const std::vector<std::string>& command)
{
    Pipe out;
    Pipe err;
    const pid_t child = SpawnSettings{out, err}.start(command);
    end_with_this_process(child);
    out.close_writer();
    err.close_writer();
    CapturedEnding ending;
    read_all(out, err, ending);
    ending.status = wait_for(child);
    return ending;
}

} // namespace gnomon::cli
