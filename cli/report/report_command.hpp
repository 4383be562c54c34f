#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon report`.
void add_report_command(CLI::App& program);

} // namespace gnomon::cli
