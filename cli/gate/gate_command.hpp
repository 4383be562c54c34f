#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon gate`.
void add_gate_command(CLI::App& program);

} // namespace gnomon::cli
