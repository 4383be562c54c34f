#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>

namespace gnomon::cli {

/// Adds `gnomon baseline save`, `list` and `diff`.
void add_baseline_command(CLI::App& program);

/// Whether a baseline is of use without the masks of wrong pixels that it names.
enum class Masks : std::uint8_t { not_needed, required };

/// Reads a baseline; where it or a mask is missing, says so and ends the program with exit
/// status 3.
/// @throws scene::InputError  as `reports::read_baseline` and `reports::require_masks` do.
[[nodiscard]] analysis::GateEntries baseline_or_end(const std::filesystem::path& file,
                                                    Masks masks = Masks::not_needed);

} // namespace gnomon::cli
