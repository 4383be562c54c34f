#pragma once

#include <filesystem>

namespace gnomon::store {

/// Keeps every other process from writing into a RUN folder, as long as it lives.
///
/// RUN/lock is locked with flock(2) and says who holds it. The lock goes with its process, however
/// that ends, so that nothing left behind ever blocks; the file goes too, unless the process is
/// killed.
class RunLock {
public:
    /// Makes the folder where there is none, takes its lock, and removes what a killed owner had
    /// begun to write (`remove_leftovers`).
    /// @throws scene::InputError  if another process holds it, saying which and since when.
    /// @throws scene::EnvironmentError  if the folder cannot be made or written.
    explicit RunLock(const std::filesystem::path& folder);
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;
    ~RunLock();

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

} // namespace gnomon::store
