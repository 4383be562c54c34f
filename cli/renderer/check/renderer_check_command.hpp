#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon renderer-check`.
void add_renderer_check_command(CLI::App& program);

} // namespace gnomon::cli
