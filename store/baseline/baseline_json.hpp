#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <cstdint>
#include <string>

namespace gnomon::store {

/// The layout of baselines (docs/gate.md).
inline constexpr int baseline_schema = 2;
/// A baseline is no longer than this.
inline constexpr std::uint64_t most_baseline_bytes = std::uint64_t{64} << 20U;

/// The text of a baseline: sorted, a line for each parameter and metric. The same results give the
/// same bytes.
/// @param run  Sorted, as `sort_entries` leaves it; `GateEntry::pixels` are names of masks.
[[nodiscard]] std::string baseline_json(const analysis::GateEntries& run);

} // namespace gnomon::store
