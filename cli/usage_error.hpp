#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace gnomon::cli {

/// What a wrong command line lacks or has too much of, in one line, with the nearest command or
/// option where one is unknown.
[[nodiscard]] std::string usage_error(const CLI::App& program, const CLI::ParseError& error);

} // namespace gnomon::cli
