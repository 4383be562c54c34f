#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon figure`.
void add_figure_command(CLI::App& program);

} // namespace gnomon::cli
