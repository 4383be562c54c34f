#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon depth`: how precisely a depth buffer stores distances, by formula and by measurement.
void add_depth_command(CLI::App& program);

} // namespace gnomon::cli
