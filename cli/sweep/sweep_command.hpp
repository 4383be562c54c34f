#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon sweep` to the program.
void add_sweep_command(CLI::App& program);

} // namespace gnomon::cli
