#pragma once

#include <filesystem>

namespace gnomon::store {

/// Keeps other processes from writing into a RUN folder.
///
/// RUN/lock is locked with flock(2) and names its holder. The lock ends with its process, so a file
/// left by a killed process never blocks.
class RunLock {
public:
    /// Creates the folder if missing, locks it, and removes temporary files of a killed process
    /// (`remove_leftovers`).
    /// @throws scene::InputError  if another process holds the lock; names it and the time.
    /// @throws scene::EnvironmentError  if the folder cannot be created or written.
    explicit RunLock(const std::filesystem::path& folder);
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;
    ~RunLock();

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// Removes temporary files of a run's CSV files and layers that a killed process left. Ignores
/// files that cannot be removed.
/// @param folder  RUN; the caller holds its `RunLock`.
void remove_leftovers(const std::filesystem::path& folder);

} // namespace gnomon::store
