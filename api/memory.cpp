#include "api/memory.hpp"

#include "api/control_group.hpp"
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

namespace gnomon::api {
namespace {

constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;

// Bytes a pixel: receivers 4 + 16 + 16 + 4, lookup 16 + 8 on the GPU; triangle 4, sample 16,
// class, reason and witness 6, P 12 and one layer in flight 16 in memory.
constexpr std::uint64_t bytes_per_pixel = 64 + 54;

/// Formats take up to 4 bytes a texel; of those that the shader converts, too, lookups need the
/// depth alone. Colour formats are drawn beside a depth buffer, one for all maps. What a method
/// makes of the map comes on top.
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

/// What `ulimit -v` leaves [bytes].
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

/// What of the process is in memory [bytes]; 0 if unknown.
std::uint64_t resident_bytes()
{
    std::uint64_t pages = 0;
    std::uint64_t resident_pages = 0;
    std::ifstream{"/proc/self/statm"} >> pages >> resident_pages;
    return resident_pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// @param is_kept  else images and textures go back as they are freed, and the rest of what is free
///                 goes back now.
void keep_freed_memory([[maybe_unused]] bool is_kept)
{
#if defined(__GLIBC__)
    constexpr int most_mappings = 65'536; // glibc's own
    // Fixed: else it grows with what is freed, to 32 MiB, and one small block that is allocated
    // behind images keeps all of them.
    constexpr int largest_unmapped = 2 << 20;
    constexpr int trim_threshold = 2 * largest_unmapped; // as glibc has it
    mallopt(M_MMAP_MAX, is_kept ? 0 : most_mappings);    // a mapping goes back when it is freed
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
