#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon certify`: registers its options; the callback runs it, and leaves with
/// CLI::RuntimeError{1} where it refutes.
void add_certify_command(CLI::App& program);

} // namespace gnomon::cli
