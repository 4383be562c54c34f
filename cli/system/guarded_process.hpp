#pragma once

#include "cli/system/child_process.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// The result of waiting for a line of another program.
struct AwaitedLine {
    enum class End {
        line,
        timeout,
        ended,    ///< the program ended, or closed its standard output
        too_long, ///< no end of line within `GuardedProcess::longest_line`
    };

    End end = End::timeout;
    std::string text; ///< without its end of line; else what arrived of it
};

/// A program that exchanges lines by its standard streams. It leaves nothing behind, neither
/// processes nor the folder that it was given (`guard_process`).
class GuardedProcess {
public:
    using Seconds = std::chrono::duration<double>;
    static constexpr std::size_t longest_line = 4UL << 20UL; ///< [bytes]

    /// @param command  The program, found in PATH, and its arguments; not empty.
    /// @param folder   An existing folder. The program starts in the new folder `folder`/work,
    /// which
    ///                 is its TMPDIR. The destructor removes all of `folder`.
    /// @throws scene::EnvironmentError  if there are no processes, pipes or folders. A command that
    ///                                  cannot be run says so in `last_errors`.
    GuardedProcess(const std::vector<std::string>& command, std::filesystem::path folder);
    GuardedProcess(const GuardedProcess&) = delete;
    GuardedProcess& operator=(const GuardedProcess&) = delete;
    ~GuardedProcess();

    /// Writes a line; false if the program did not read it in time.
    [[nodiscard]] bool write_line(std::string_view text, Seconds longest);
    void close_input() { in_.close_writer(); }
    [[nodiscard]] AwaitedLine read_line(Seconds longest);
    /// Whether it has written more than was read.
    [[nodiscard]] bool has_more();
    /// Its exit status, or 128 + the signal that ended it; empty if it does not end in time.
    [[nodiscard]] std::optional<int> wait(Seconds longest);
    /// The end of its standard error, at most 4096 bytes.
    [[nodiscard]] std::string last_errors();

private:
    /// Reads what has arrived on both streams, or waits for it; false if nothing came in time.
    bool take(std::chrono::steady_clock::time_point until);
    /// Removes the first whole line from `output_`.
    [[nodiscard]] std::optional<std::string> next_line();

    std::filesystem::path folder_;
    Pipe in_;
    Pipe out_;
    Pipe err_;
    int socket_ = -1; ///< to the guard
    pid_t guard_ = 0;
    std::optional<int> status_;
    std::string output_; ///< not read yet
    std::string errors_; ///< the end of them
};

/// The first argument that makes the program guard another one instead of running a command.
inline constexpr std::string_view guard_word = "--guard-process";

/// The guard's descriptor of the socket to its owner.
inline constexpr int guard_socket = 3;

/// Runs the arguments after `guard_word`, FOLDER COMMAND..., as the guard of that command.
///
/// The command starts in FOLDER, its TMPDIR, in its own process group, with the guard's standard
/// streams. When the command ends, or the owner closes `guard_socket`, the guard kills all that the
/// command started, in whatever group or session, and writes the exit status to the socket as an
/// `int`. Once the owner has closed the socket, the guard removes FOLDER's parent folder.
///
/// As a process of its own, the guard cleans up even if its owner is killed.
/// @return  the command's exit status, 128 + the signal that ended it, or 127 if it cannot be run.
int guard_process(int argc, char** argv);

} // namespace gnomon::cli
