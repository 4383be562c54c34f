#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon methods`: lists how a map can decide, and what each way promises.
void add_methods_command(CLI::App& program);

} // namespace gnomon::cli
