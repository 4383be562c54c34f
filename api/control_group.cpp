#include "api/control_group.hpp"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>

namespace gnomon::api {

namespace {

/// How one version of control groups names what it says of memory.
struct Hierarchy {
    std::string_view controller; ///< as /proc/self/cgroup names it
    std::string_view mount;
    std::string_view limit;
    std::string_view usage;
    std::string_view droppable; ///< a key of memory.stat
};
constexpr Hierarchy version_2{"", "sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};
constexpr Hierarchy version_1{"memory", "sys/fs/cgroup/memory", "memory.limit_in_bytes",
                              "memory.usage_in_bytes", "total_inactive_file"};
/// Version 1 writes "no limit" as the largest whole number of pages.
constexpr std::uint64_t no_limit = std::uint64_t{1} << 62U;

/// The number in a file; empty if there is none, as in "max".
std::optional<std::uint64_t> read_number(const std::filesystem::path& path)
{
    std::uint64_t number = 0;
    return std::ifstream{path} >> number ? std::optional{number} : std::nullopt;
}

std::uint64_t read_statistic(const std::filesystem::path& path, std::string_view name)
{
    std::ifstream file{path};
    std::string key;
    std::uint64_t value = 0;
    while (file >> key >> value) {
        if (key == name) {
            return value;
        }
    }
    return 0;
}

/// What one group leaves.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& group,
                                        const Hierarchy& hierarchy)
{
    const auto limit = read_number(group / hierarchy.limit);
    const auto usage = read_number(group / hierarchy.usage);
    if (!limit || !usage || *limit >= no_limit) {
        return std::nullopt;
    }
    const std::uint64_t droppable = read_statistic(group / "memory.stat", hierarchy.droppable);
    const std::uint64_t used = *usage - std::min(droppable, *usage);
    return *limit - std::min(used, *limit);
}

/// The group of this process in a hierarchy, "/" being its root; empty if it has none.
std::optional<std::filesystem::path> group_of_process(const std::filesystem::path& root,
                                                      std::string_view controller)
{
    std::ifstream file{root / "proc/self/cgroup"};
    std::string line; // ID:CONTROLLERS:PATH
    while (std::getline(file, line)) {
        const auto first = line.find(':');
        const auto second = line.find(':', first + 1);
        if (second != std::string::npos &&
            std::string_view{line}.substr(first + 1, second - first - 1) == controller) {
            return line.substr(second + 1);
        }
    }
    return std::nullopt;
}

} // namespace

std::optional<std::uint64_t> control_group_memory_bytes(const std::filesystem::path& root)
{
    std::optional<std::uint64_t> least;
    for (const Hierarchy& hierarchy : {version_2, version_1}) {
        const auto group = group_of_process(root, hierarchy.controller);
        if (!group) {
            continue;
        }
        // In a container the path may be the host's: then the mount itself is the group.
        for (std::filesystem::path path = group->relative_path();; path = path.parent_path()) {
            const auto bytes = free_bytes(root / hierarchy.mount / path, hierarchy);
            if (bytes && (!least || *bytes < *least)) {
                least = bytes;
            }
            if (path.empty()) {
                break;
            }
        }
    }
    return least;
}

} // namespace gnomon::api
