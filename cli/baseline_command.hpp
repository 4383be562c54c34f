#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>

namespace gnomon::cli {

/// Adds `gnomon baseline save`, `list` and `diff`.
void add_baseline_command(CLI::App& program);

/// Reads a baseline; where there is none, says so and ends the program with exit status 3.
/// @throws scene::InputError  as `reports::read_baseline` does.
[[nodiscard]] analysis::GateEntries baseline_or_end(const std::filesystem::path& file);

} // namespace gnomon::cli
