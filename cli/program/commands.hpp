#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Describes the program: its commands in the order of their list. Help, completion, the manual
/// page and docs/commands.md are made from what it says.
void describe_program(CLI::App& program);

} // namespace gnomon::cli
