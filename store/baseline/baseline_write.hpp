#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "store/baseline/gate_run.hpp"

#include <filesystem>

namespace gnomon::store {

/// A run's results with the names that the masks of its wrong pixels have, without writing them.
/// @throws scene::InputError  if kept pixels cannot be read.
[[nodiscard]] analysis::GateEntries with_mask_names(const GateRun& run);

/// Writes the masks of wrong pixels that a run's configurations have beside a baseline.
/// @return  The run's results with the masks' names; none where no pixels were kept.
/// @throws scene::InputError        if kept pixels cannot be read.
/// @throws scene::EnvironmentError  if a mask cannot be written.
[[nodiscard]] analysis::GateEntries write_masks(const std::filesystem::path& baseline,
                                                const GateRun& run);

/// Writes a baseline whose masks are written, and removes masks that it does not name.
/// @throws scene::InputError        if it is too long.
/// @throws scene::EnvironmentError  if it cannot be written.
void write_baseline(const std::filesystem::path& file, const analysis::GateEntries& entries);

} // namespace gnomon::store
