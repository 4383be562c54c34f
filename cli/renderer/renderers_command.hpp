#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon renderers`.
void add_renderers_command(CLI::App& program);

} // namespace gnomon::cli
