#pragma once

#include "analysis/gate/gate_entries.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// What of a baseline is replaced by a run's results.
enum class BaselineUpdate : std::uint8_t {
    missing, ///< configurations that it lacks are added
    changed, ///< those that are not as they were are replaced
    all,     ///< it becomes the run's, which also takes away what the run lacks
};

/// The baseline after an update.
/// @param run  Its `GateEntry::pixels` are names of masks. One whose pixels were not kept keeps the
///             baseline's mask if all else is as it was, its renderer included.
/// @throws std::invalid_argument  unless all is taken, if axes or renderers differ.
[[nodiscard]] GateEntries updated_baseline(const GateEntries& baseline, const GateEntries& run,
                                           BaselineUpdate update);

/// Whether both have the same axes and renderer, so that one baseline may hold entries of both.
[[nodiscard]] bool can_be_merged(const GateEntries& baseline, const GateEntries& run);

} // namespace gnomon::analysis
