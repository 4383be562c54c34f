#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <string>

namespace gnomon::store {

/// Why a configuration of a baseline cannot be what a run measured: counts of pixels beyond the
/// image's, sums that do not add up, rates that are not what their counts give, or parts that are
/// not those of the whole; empty if nothing of the kind is found. Hand-edited numbers would
/// otherwise let regressions pass.
[[nodiscard]] std::string find_contradiction(const analysis::GateEntry& entry);

} // namespace gnomon::store
