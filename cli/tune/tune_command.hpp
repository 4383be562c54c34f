#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon tune JOB`: recommends settings that keep errors below the user's limits.
void add_tune_command(CLI::App& program);

} // namespace gnomon::cli
