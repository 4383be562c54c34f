#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon doctor`: what GL, Embree and drivers are here, what is missing, and how to get it.
void add_doctor_command(CLI::App& program);

} // namespace gnomon::cli
