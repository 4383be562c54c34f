#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon init [FILE]`: writes a commented job file.
void add_init_command(CLI::App& program);

} // namespace gnomon::cli
