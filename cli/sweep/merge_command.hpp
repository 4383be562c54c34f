#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon merge`.
void add_merge_command(CLI::App& program);

} // namespace gnomon::cli
