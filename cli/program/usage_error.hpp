#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace gnomon::cli {

/// The commands below a command, or below the program.
[[nodiscard]] std::vector<std::string> command_names(const CLI::App& app);

/// What a wrong command line lacks or has too much of, in one line, with the nearest command or
/// option where one is unknown.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

} // namespace gnomon::cli
