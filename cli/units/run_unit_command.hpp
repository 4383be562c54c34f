#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon run-unit`.
void add_run_unit_command(CLI::App& program);

} // namespace gnomon::cli
