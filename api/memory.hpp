#pragma once

#include "scene/job/file.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

namespace gnomon::api {

/// Memory that this process's control groups leave free [bytes]: the minimum over all groups up to
/// the root, such as a container's. Droppable cache counts as free.
/// @param root  folder that holds proc and sys.
/// @return  Empty if no group has a readable limit.
/// Source: Linux, Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst.
[[nodiscard]] std::optional<std::uint64_t>
control_group_memory_bytes(const std::filesystem::path& root = "/");

/// Memory available for new work [bytes]: the least of MemAvailable and the limits of `ulimit -v`
/// and the control groups; 0 if unknown.
[[nodiscard]] std::uint64_t available_memory_bytes();

/// Memory that the job's image and shadow map need, on CPU and GPU [bytes].
[[nodiscard]] std::uint64_t needed_memory_bytes(const scene::Job& job);

/// Keeps freed memory in a small process for later allocations. Software GL allocates a texture for
/// each shadow map, and the kernel clears new pages, which cost a tenth of a long sweep. Large
/// processes still return freed memory. Does nothing without glibc.
class FreedMemoryKeeper {
public:
    FreedMemoryKeeper() = default;
    FreedMemoryKeeper(const FreedMemoryKeeper&) = delete;
    FreedMemoryKeeper& operator=(const FreedMemoryKeeper&) = delete;
    /// Returns the kept memory.
    ~FreedMemoryKeeper();

    /// Keeps freed memory from now on if resident and needed memory sum to at most 0.6 GiB; else
    /// returns it.
    void keep(std::uint64_t needed_bytes);
    /// Returns all kept memory, and stops keeping it, if the process holds more than 1.2 GiB. Call
    /// it now and then.
    void limit();

private:
    bool keeps_ = false;
};

/// @throws scene::InputError  if the job needs more memory than is available.
void require_memory(const scene::Job& job);
/// As above for the jobs of several lights, whose images are all kept in memory.
/// @param jobs  at least one.
void require_memory(std::span<const scene::LightJob> jobs);

} // namespace gnomon::api
