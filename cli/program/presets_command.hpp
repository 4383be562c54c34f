#pragma once

#include <CLI/CLI.hpp>

namespace gnomon::cli {

/// `gnomon presets`: the shadow maps of lessons and engines, by themselves or on a job.
void add_presets_command(CLI::App& program);

} // namespace gnomon::cli
