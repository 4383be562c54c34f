#pragma once

#include <spawn.h>
#include <sys/types.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// A pipe whose ends are closed in children unless they are passed on.
class Pipe {
public:
    /// @throws scene::EnvironmentError  if no pipe can be made.
    Pipe();
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe();

    [[nodiscard]] int reader() const { return ends_[0]; }
    [[nodiscard]] int writer() const { return ends_[1]; }
    void close_reader() { close_end(ends_[0]); }
    void close_writer() { close_end(ends_[1]); }

private:
    static void close_end(int& end);

    std::array<int, 2> ends_{-1, -1};
};

/// Appends the bytes that have arrived; false at the end of the stream.
bool read_some(int descriptor, std::string& text);

/// Throws if a system call failed.
/// @param code  0 or an errno value.
/// @throws scene::EnvironmentError  naming the call.
void require_call(int code, std::string_view call);

/// Starts a program without a shell. SIGPIPE and SIGXFSZ, which gnomon ignores, get their default
/// actions back.
class Launcher {
public:
    Launcher();
    Launcher(const Launcher&) = delete;
    Launcher& operator=(const Launcher&) = delete;
    ~Launcher();

    /// Makes an open descriptor the child's descriptor `number`.
    void pass(int descriptor, int number);
    void set_empty_input();
    void set_folder(const char* folder);
    void set_own_process_group();
    void reset_all_signals();

    /// @param program    a path, or a name to find in PATH.
    /// @param arguments  argv, the program's name first; not empty.
    /// @throws scene::EnvironmentError  if it cannot be started.
    [[nodiscard]] pid_t start(const std::string& program, std::vector<std::string> arguments);

private:
    posix_spawn_file_actions_t actions_{};
    posix_spawnattr_t attributes_{};
    short flags_ = POSIX_SPAWN_SETSIGDEF;
};

/// How a program ended, and what it wrote.
struct CapturedEnding {
    int status = 0; ///< the exit status, or 128 + the signal that ended it
    std::string out;
    std::string err;
};

/// Runs a program to its end with an empty stdin, and captures stdout and stderr. A signal that
/// ends this process ends the program first.
///
/// @param command  The program's path and its arguments; not empty.
/// @throws scene::EnvironmentError  if it cannot be started.
[[nodiscard]] CapturedEnding run_captured(const std::vector<std::string>& command);

} // namespace gnomon::cli
