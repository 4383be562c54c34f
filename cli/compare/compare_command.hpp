#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon compare`: registers its options; the callback runs it.
void add_compare_command(CLI::App& program);

} // namespace gnomon::cli
