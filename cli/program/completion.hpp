#pragma once

#include <string>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// A completion script for bash, zsh or fish, made from the program's own commands and options.
/// @throws std::invalid_argument  for another shell.
[[nodiscard]] std::string completion_script(const CLI::App& program, const std::string& shell);

} // namespace gnomon::cli
