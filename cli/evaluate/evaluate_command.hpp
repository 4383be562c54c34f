#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon evaluate CASE`: another renderer's shadow mask against the exact truth.
void add_evaluate_command(CLI::App& program);

} // namespace gnomon::cli
