#include "cli/system/child_process.hpp"

#include "cli/system/process.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace gnomon::cli {
namespace {

/// Reads both streams in turn: a child that fills one blocks until it is read.
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
            if (streams[i].revents != 0 && !read_some(streams[i].fd, *texts[i])) {
                streams[i].fd = -1; // poll skips it
            }
        }
    }
}

int wait_for(pid_t child)
{
    siginfo_t state{};
    // Until the child is reaped nobody else gets its id, so the signal handler may kill it.
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

Pipe::Pipe()
{
    require_call(::pipe2(ends_.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe2");
}

Pipe::~Pipe()
{
    close_writer();
    close_reader();
}

void Pipe::close_end(int& end)
{
    if (end >= 0) {
        ::close(end);
        end = -1;
    }
}

bool read_some(int descriptor, std::string& text)
{
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count > 0) {
        text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return count > 0 || (count < 0 && (errno == EINTR || errno == EAGAIN));
}

void require_call(int code, std::string_view call)
{
    if (code != 0) {
        throw scene::EnvironmentError(fmt::format("{} failed: {}", call, std::strerror(code)));
    }
}

Launcher::Launcher()
{
    require_call(::posix_spawn_file_actions_init(&actions_), "posix_spawn_file_actions_init");
    ::posix_spawnattr_init(&attributes_);
    sigset_t ignored{};
    ::sigemptyset(&ignored);
    ::sigaddset(&ignored, SIGPIPE);
    ::sigaddset(&ignored, SIGXFSZ);
    ::posix_spawnattr_setsigdefault(&attributes_, &ignored);
}

Launcher::~Launcher()
{
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&actions_);
}

void Launcher::pass(int descriptor, int number)
{
    ::posix_spawn_file_actions_adddup2(&actions_, descriptor, number);
}

void Launcher::set_empty_input()
{
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
}

void Launcher::set_folder(const char* folder)
{
    ::posix_spawn_file_actions_addchdir_np(&actions_, folder);
}

void Launcher::set_own_process_group()
{
    ::posix_spawnattr_setpgroup(&attributes_, 0);
    flags_ |= POSIX_SPAWN_SETPGROUP;
}

void Launcher::reset_all_signals()
{
    sigset_t signals{};
    ::sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
    ::sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    flags_ |= POSIX_SPAWN_SETSIGMASK;
}

pid_t Launcher::start(const std::string& program, std::vector<std::string> arguments)
{
    std::vector<char*> pointers;
    for (std::string& argument : arguments) {
        pointers.push_back(argument.data());
    }
    pointers.push_back(nullptr);
    ::posix_spawnattr_setflags(&attributes_, flags_);
    pid_t child = 0;
    const int code =
        ::posix_spawnp(&child, program.c_str(), &actions_, &attributes_, pointers.data(), environ);
    if (code != 0) {
        throw scene::EnvironmentError(
            fmt::format("{}: cannot be run: {}", program, std::strerror(code)));
    }
    return child;
}

CapturedEnding run_captured(const std::vector<std::string>& command)
{
    Pipe out;
    Pipe err;
    Launcher launcher;
    launcher.set_empty_input();
    launcher.pass(out.writer(), STDOUT_FILENO);
    launcher.pass(err.writer(), STDERR_FILENO);
    const pid_t child = launcher.start(command.front(), command);
    end_with_this_process(child);
    out.close_writer();
    err.close_writer();
    CapturedEnding ending;
    read_all(out, err, ending);
    ending.status = wait_for(child);
    return ending;
}

} // namespace gnomon::cli
