#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon status`.
void add_status_command(CLI::App& program);

} // namespace gnomon::cli
