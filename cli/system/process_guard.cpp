#include "cli/system/guarded_process.hpp"

#include "scene/error.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

namespace fs = std::filesystem;

constexpr int cannot_run = 127; ///< the exit status that shells use
/// How long the guard waits for killed processes: one that hangs in the kernel never ends.
constexpr std::chrono::seconds most_time_to_end{10};

/// Where the guarded command begins in argv.
constexpr int command_at = 3;

/// The parent's id, read from /proc; 0 if the process is gone.
pid_t parent_of(pid_t process)
{
    std::ifstream file{"/proc/" + std::to_string(process) + "/stat"};
    std::string text;
    std::getline(file, text, '\0');
    const std::size_t name_end = text.rfind(')'); // the name before it may hold any character
    if (name_end == std::string::npos || name_end + 4 > text.size()) {
        return 0;
    }
    return static_cast<pid_t>(std::strtol(text.c_str() + name_end + 4, nullptr, 10));
}

std::vector<pid_t> own_children()
{
    std::vector<pid_t> children;
    std::error_code error;
    for (fs::directory_iterator entry{"/proc", error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        const auto process = static_cast<pid_t>(std::strtol(name.c_str(), nullptr, 10));
        if (process > 0 && parent_of(process) == ::getpid()) {
            children.push_back(process);
        }
    }
    return children;
}

/// Kills the group and all descendants: orphans become children of this process, a subreaper.
void end_all(pid_t group)
{
    ::kill(-group, SIGKILL);
    const auto deadline = std::chrono::steady_clock::now() + most_time_to_end;
    while (std::chrono::steady_clock::now() < deadline) {
        for (const pid_t child : own_children()) {
            ::kill(child, SIGKILL);
        }
        pid_t reaped = 0;
        do {
            reaped = ::waitpid(-1, nullptr, WNOHANG);
        } while (reaped > 0 || (reaped < 0 && errno == EINTR));
        if (reaped < 0) {
            return; // no child is left
        }
        std::this_thread::sleep_for(std::chrono::milliseconds{2});
    }
}

/// Removes the folder, even if the program took away permissions in it.
void remove_folder(const fs::path& folder)
{
    std::error_code error;
    fs::remove_all(folder, error);
    for (int depth = 0; error && depth < 16; ++depth) {
        std::error_code unreadable;
        fs::permissions(folder, fs::perms::owner_all, fs::perm_options::add, unreadable);
        for (fs::recursive_directory_iterator entry{
                 folder, fs::directory_options::skip_permission_denied, unreadable};
             !unreadable && entry != fs::recursive_directory_iterator{};
             entry.increment(unreadable)) {
            std::error_code unknown;
            if (entry->symlink_status(unknown).type() == fs::file_type::directory) {
                fs::permissions(entry->path(), fs::perms::owner_all, fs::perm_options::add,
                                unknown);
            }
        }
        fs::remove_all(folder, error);
    }
}

/// Starts the command in a process group of its own; 0 and a line on stderr if it cannot be run.
pid_t start_command(const char* folder, std::vector<std::string> command)
{
    Launcher launcher;
    launcher.set_folder(folder);
    launcher.set_own_process_group();
    launcher.reset_all_signals();
    try {
        const std::string program = command.front();
        return launcher.start(program, std::move(command));
    } catch (const scene::EnvironmentError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 0;
    }
}

/// Closes the guard's copies of the streams, so that their readers see the command's end.
void release_streams()
{
    const int null = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        ::dup2(null, stream);
    }
}

/// Waits until the command or the owner ends; true if the command did.
bool wait_for_either(pid_t child)
{
    // glibc 2.36 declares pidfd_open() with C++ linkage, so it cannot be linked.
    const int watched = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
    std::array<pollfd, 2> events{{{watched, POLLIN, 0}, {guard_socket, POLLIN, 0}}};
    while (::poll(events.data(), events.size(), -1) < 0 && errno == EINTR) {
    }
    ::close(watched);
    return events[0].revents != 0;
}

void wait_for_owner()
{
    pollfd event{guard_socket, POLLIN, 0};
    while (::poll(&event, 1, -1) < 0 && errno == EINTR) {
    }
}

/// Waits for the command or the owner to end, and kills what is left; returns the exit status.
int guard(pid_t child)
{
    int status = 128 + SIGKILL;
    if (wait_for_either(child)) {
        int state = 0;
        while (::waitpid(child, &state, 0) < 0 && errno == EINTR) {
        }
        status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    }
    end_all(child);
    return status;
}

} // namespace

int guard_process(int argc, char** argv)
{
    if (argc <= command_at) {
        return cannot_run;
    }
    const fs::path folder{argv[2]};
    ::fcntl(guard_socket, F_SETFD, FD_CLOEXEC);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        ::signal(signal, SIG_IGN);
    }
    ::setenv("TMPDIR", folder.c_str(), 1);
    const pid_t child = start_command(folder.c_str(), {argv + command_at, argv + argc});
    release_streams();
    const int status = child > 0 ? guard(child) : cannot_run;
    [[maybe_unused]] const ssize_t written =
        ::send(guard_socket, &status, sizeof(status), MSG_NOSIGNAL);
    wait_for_owner();
    remove_folder(folder.parent_path());
    return status;
}

} // namespace gnomon::cli
