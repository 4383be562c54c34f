#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon help [COMMAND…]`: what --help prints of it.
void add_help_command(CLI::App& program);

} // namespace gnomon::cli
