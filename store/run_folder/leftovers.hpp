#pragma once

#include <filesystem>

namespace gnomon::store {

/// Removes the temporary files of a run's CSV files and layers that a killed process left in the
/// folder, and no others. What cannot be removed stays: it does no harm.
/// @param folder  RUN, which nobody writes: its `RunLock` is held.
void remove_leftovers(const std::filesystem::path& folder);

} // namespace gnomon::store
