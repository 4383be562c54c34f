#include "api/memory.hpp"

#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"

#include <fmt/format.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::api {

namespace {

/// The names that a control group version uses for memory.
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

/// The number in a file; empty for other text, such as "max".
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

/// The memory that one group leaves free.
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

/// This process's group in a hierarchy, whose root is "/"; empty if it has none.
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
        // In a container the path may be the host's; the mount itself is then the group.
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

namespace {

constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;

// Bytes per pixel. GPU: receivers 4 + 16 + 16 + 4, lookup 16 + 8. CPU: triangle 4, sample 16,
// class, reason and witness 6, P 12, one layer in flight 16.
constexpr std::uint64_t bytes_per_pixel = 64 + 54;

/// Formats take up to 4 bytes per texel, also those that the shader converts. Colour formats need
/// one extra depth buffer, and prefiltered maps are added on top.
constexpr std::uint64_t bytes_per_texel = 4;

/// MemAvailable of the machine [bytes].
std::optional<std::uint64_t> free_memory_bytes()
{
    std::ifstream file{"/proc/meminfo"};
    std::string key;
    std::uint64_t kibibytes = 0;
    while (file >> key >> kibibytes) {
        if (key == "MemAvailable:") {
            return kibibytes * 1024;
        }
        file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return std::nullopt;
}

/// Address space left by `ulimit -v` [bytes].
std::optional<std::uint64_t> free_address_space_bytes()
{
    rlimit limit{};
    std::uint64_t used_pages = 0;
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
        !(std::ifstream{"/proc/self/statm"} >> used_pages)) {
        return std::nullopt;
    }
    const std::uint64_t used = used_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return limit.rlim_cur - std::min<std::uint64_t>(used, limit.rlim_cur);
}

/// Resident memory of the process [bytes]; 0 if unknown.
std::uint64_t resident_bytes()
{
    std::uint64_t pages = 0;
    std::uint64_t resident_pages = 0;
    std::ifstream{"/proc/self/statm"} >> pages >> resident_pages;
    return resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// @param is_kept  if false, images and textures are returned when freed, and other free memory is
///                 returned now.
void keep_freed_memory([[maybe_unused]] bool is_kept)
{
#if defined(__GLIBC__)
    constexpr int most_mappings = 65'536; // glibc's default
    // Fixed, because glibc raises the threshold up to 32 MiB as blocks are freed, and one small
    // block allocated behind images would then keep all of them.
    constexpr int largest_unmapped = 2 << 20;
    constexpr int trim_threshold = 2 * largest_unmapped; // glibc's default ratio
    mallopt(M_MMAP_MAX, is_kept ? 0 : most_mappings);    // freed mappings are returned at once
    mallopt(M_MMAP_THRESHOLD, largest_unmapped);
    mallopt(M_TRIM_THRESHOLD, is_kept ? std::numeric_limits<int>::max() : trim_threshold);
    if (!is_kept) {
        malloc_trim(0);
    }
#endif
}

} // namespace

FreedMemoryKeeper::~FreedMemoryKeeper()
{
    if (keeps_) {
        keep_freed_memory(false);
    }
}

void FreedMemoryKeeper::keep(std::uint64_t needed_bytes)
{
    constexpr auto most_bytes = static_cast<std::uint64_t>(0.6 * gibibyte);
    if (!keeps_) {
        keeps_ = resident_bytes() + needed_bytes <= most_bytes;
        keep_freed_memory(keeps_);
    }
}

void FreedMemoryKeeper::limit()
{
    constexpr auto most_bytes = static_cast<std::uint64_t>(1.2 * gibibyte);
    if (keeps_ && resident_bytes() > most_bytes) {
        keep_freed_memory(false);
        keeps_ = false;
    }
}

std::uint64_t available_memory_bytes()
{
    constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t available = std::min({free_memory_bytes().value_or(unknown),
                                              free_address_space_bytes().value_or(unknown),
                                              control_group_memory_bytes().value_or(unknown)});
    return available == unknown ? 0 : available;
}

std::uint64_t needed_memory_bytes(const scene::Job& job)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    const std::uint64_t depth_buffer_bytes =
        traits_of(job.shadow_map.depth_format).is_colour ? side * side * bytes_per_texel : 0;
    return job.image.pixel_count() * bytes_per_pixel + depth_buffer_bytes +
           std::max(side * side * bytes_per_texel, methods::traits(job).map_bytes);
}

void require_memory(const scene::Job& job)
{
    const std::array one{scene::LightJob{{}, job}};
    require_memory(one);
}

void require_memory(std::span<const scene::LightJob> jobs)
{
    const scene::LightJob* largest = &jobs.front();
    for (const scene::LightJob& each : jobs) {
        if (needed_memory_bytes(each.job) > needed_memory_bytes(largest->job)) {
            largest = &each;
        }
    }
    const scene::Job& job = largest->job;
    const std::uint64_t needed =
        needed_memory_bytes(job) + (jobs.size() - 1) * job.image.pixel_count() * bytes_per_pixel;
    const std::uint64_t available = available_memory_bytes();
    if (available != 0 && needed > available) {
        const std::string lights =
            jobs.size() > 1 ? fmt::format(", {} lights", jobs.size()) : std::string{};
        throw scene::InputError(fmt::format(
            "image.width = {}, image.height = {}, shadow_map.resolution = {}{}: this needs about "
            "{:.1f} GiB of memory and {:.1f} GiB are available: make them smaller",
            job.image.width_px, job.image.height_px, job.shadow_map.resolution_texels, lights,
            static_cast<double>(needed) / gibibyte, static_cast<double>(available) / gibibyte));
    }
}

} // namespace gnomon::api
