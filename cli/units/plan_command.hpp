#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// Adds `gnomon plan`.
void add_plan_command(CLI::App& program);

} // namespace gnomon::cli
