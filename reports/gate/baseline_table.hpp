#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <string>

namespace gnomon::reports {

/// "with masks of wrong pixels for 16", or that it has none.
[[nodiscard]] std::string masks_text(const analysis::GateEntries& baseline);

/// What `gnomon baseline list` prints: where the baseline comes from, and a line a configuration.
[[nodiscard]] std::string baseline_table(const analysis::GateEntries& baseline);

/// What `gnomon baseline diff` prints: of each configuration that changed the parameters, then the
/// metrics that are not what they were; and which are missing and new.
/// @param run  As it is now; both are sorted. Its `GateEntry::pixels` are names of masks, or empty.
[[nodiscard]] std::string baseline_difference(const analysis::GateEntries& baseline,
                                              const analysis::GateEntries& run);

} // namespace gnomon::reports
