#pragma once

#include "cli/system/pipe.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// What came of waiting for a line of another program.
struct AwaitedLine {
    enum class End {
        line,     ///< it came
        timeout,  ///< it did not
        ended,    ///< the program ended, or closed its standard output
        too_long, ///< what came has no end of line
    };

    End end = End::timeout;
    std::string text; ///< without its end of line
};

/// Another program that is talked to in lines, by its standard streams, and leaves nothing behind:
/// neither processes, whatever it started, nor the folder that it was given (`guard_process`).
class GuardedProcess {
public:
    using Seconds = std::chrono::duration<double>;
    static constexpr std::size_t longest_line = 4UL << 20UL; ///< [bytes]

    /// @param command  The program, found in PATH, and its arguments; not empty.
    /// @param folder   is there. The program is started in `folder`/work, which is made, and that
    /// is
    ///                 its TMPDIR. All of `folder` is removed when this ends.
    /// @throws scene::EnvironmentError  if there are no processes, pipes or folders. A command that
    ///                                  cannot be run says so as its last words.
    GuardedProcess(const std::vector<std::string>& command, std::filesystem::path folder);
    GuardedProcess(const GuardedProcess&) = delete;
    GuardedProcess& operator=(const GuardedProcess&) = delete;
    ~GuardedProcess();

    /// Writes a line; false if it was not taken in time.
    [[nodiscard]] bool write_line(std::string_view text, Seconds longest);
    /// Closes its standard input.
    void close_input() { in_.close_writer(); }
    [[nodiscard]] AwaitedLine read_line(Seconds longest);
    /// Whether it said more than was read.
    [[nodiscard]] bool has_more();
    /// Its exit status, or 128 + the signal that ended it; empty if it does not end in time.
    [[nodiscard]] std::optional<int> wait(Seconds longest);
    /// The end of what it wrote to its standard error.
    [[nodiscard]] std::string last_words();

private:
    /// Takes what has come, of both streams, or waits for something; false: nothing came in time.
    bool take(std::chrono::steady_clock::time_point until);
    /// The next line of what was taken.
    [[nodiscard]] std::optional<std::string> next_line();

    std::filesystem::path folder_;
    Pipe in_;
    Pipe out_;
    Pipe err_;
    int socket_ = -1; ///< the guard's other end
    pid_t guard_ = 0;
    std::optional<int> status_;
    std::string said_;       ///< and not read
    std::string complaints_; ///< the end of them
};

} // namespace gnomon::cli
