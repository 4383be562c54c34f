#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace gnomon::api {

/// Memory that the control groups of this process leave it [bytes]: the least that any group on the
/// way to the root does; a container's limit is such a group. Cache that the kernel can drop counts
/// as free.
/// @param root  where /proc and /sys are found.
/// @return  empty if no group is limited, or none can be read.
/// Source: Linux, Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst.
[[nodiscard]] std::optional<std::uint64_t>
control_group_memory_bytes(const std::filesystem::path& root = "/");

} // namespace gnomon::api
