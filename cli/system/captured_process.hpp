#pragma once

#include <string>
#include <vector>

namespace gnomon::cli {

/// How a program ended, and what it wrote.
struct CapturedEnding {
    int status = 0; ///< its exit status, or 128 + the signal that ended it
    std::string out;
    std::string err;
};

/// Runs a program to its end, without a shell: its stdin is empty, stdout and stderr are captured.
/// A signal that ends this process meanwhile ends the program too.
///
/// @param command  The program's path and its arguments; not empty.
/// @throws scene::EnvironmentError  if it cannot be started; `what()` names the reason.
[[nodiscard]] CapturedEnding run_captured(const std::vector<std::string>& command);

} // namespace gnomon::cli
