#pragma once

#include "analysis/gate/gate_entries.hpp"
#include "store/baseline/gate_run.hpp"
#include "store/baseline/pixel_mask.hpp"

#include <cstdint>
#include <filesystem>
#include <string>

namespace gnomon::store {

/// The version of the baseline format (docs/gate.md).
inline constexpr int baseline_schema = 2;
/// The greatest size of a baseline file.
inline constexpr std::uint64_t most_baseline_bytes = std::uint64_t{64} << 20U;

/// The text of a baseline, sorted, with one parameter or metric a line. Equal results give equal
/// bytes.
/// @param run  sorted by `sort_entries`; `GateEntry::pixels` are names of masks.
[[nodiscard]] std::string baseline_json(const analysis::GateEntries& run);

/// Reads a file that `baseline_json` wrote. The file may be hostile.
/// @throws BaselineMissing    if the file does not exist.
/// @throws scene::InputError  naming the file and the place in it, if the text is truncated, nests
///                            too deeply, repeats, lacks or adds a key, or holds an invalid value.
[[nodiscard]] analysis::GateEntries read_baseline(const std::filesystem::path& file);

/// @param name  of the text, for messages.
[[nodiscard]] analysis::GateEntries parse_baseline(const std::string& text,
                                                   const std::string& name);

/// Finds a contradiction in a configuration's numbers: counts beyond the image, sums that do not
/// add up, rates that differ from their counts, or parts that differ from the whole. Without this
/// check, hand-edited numbers could let regressions pass.
/// @return  A sentence; empty if the numbers agree.
[[nodiscard]] std::string find_contradiction(const analysis::GateEntry& entry);

/// A run's results with the names of the masks of its wrong pixels; does not write the masks.
/// @throws scene::InputError  if kept pixels cannot be read.
[[nodiscard]] analysis::GateEntries with_mask_names(const GateRun& run);

/// Writes the masks of a run's wrong pixels beside a baseline.
/// @return  The run's results with the names of the masks; without names if pixels were not kept.
/// @throws scene::InputError        if kept pixels cannot be read.
/// @throws scene::EnvironmentError  if a mask cannot be written.
[[nodiscard]] analysis::GateEntries write_masks(const std::filesystem::path& baseline,
                                                const GateRun& run);

/// Writes a baseline after its masks, and removes masks that it does not name.
/// @throws scene::InputError        if the text is too long.
/// @throws scene::EnvironmentError  if the file cannot be written.
void write_baseline(const std::filesystem::path& file, const analysis::GateEntries& entries);

} // namespace gnomon::store
