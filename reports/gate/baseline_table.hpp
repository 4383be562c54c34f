#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <string>

namespace gnomon::reports {

/// "with masks of wrong pixels for 16", or that the baseline has no masks.
[[nodiscard]] std::string masks_text(const analysis::GateEntries& baseline);

/// The output of `gnomon baseline list`: the baseline's origin, and one line per configuration.
[[nodiscard]] std::string baseline_table(const analysis::GateEntries& baseline);

/// The output of `gnomon baseline diff`: for each changed configuration its parameters and
/// metrics, then the missing and the new configurations.
/// @param run  The current results. Both are sorted; the run's `GateEntry::pixels` are mask names,
///             or empty.
[[nodiscard]] std::string baseline_difference(const analysis::GateEntries& baseline,
                                              const analysis::GateEntries& run);

} // namespace gnomon::reports
