#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon scenes`: lists the built-in scenes and their parameters.
void add_scenes_command(CLI::App& program);

} // namespace gnomon::cli
