#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon baseline save`, `list` and `diff`.
void add_baseline_command(CLI::App& program);

} // namespace gnomon::cli
