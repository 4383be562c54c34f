#include "store/case/case_image_file.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::store {

namespace {

constexpr const char* case_advice = "write it as docs/evaluate.md says";
/// As of a job's image.
constexpr std::uint64_t most_image_pixels = 134'217'728;

} // namespace

using scene::ImageSize;
using scene::Vec3f;

CaseImageFile::CaseImageFile(const std::filesystem::path& path, std::uint64_t memory_bytes)
    : name_{scene::one_line(path.string())},
      file_{path, case_advice}
{
    const ImageSize size = file_.size();
    refuse_encoding();
    if (size.pixel_count() > most_image_pixels) {
        refuse(fmt::format("{}x{} pixels; must be at most {}", size.width_px, size.height_px,
                           most_image_pixels));
    }
    // What is decoded, and about as much again for the layers and the truth.
    const std::uint64_t needed = file_.decoded_bytes() + 128 * size.pixel_count();
    if (memory_bytes != 0 && needed > memory_bytes) {
        constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
        refuse(fmt::format("{}x{} pixels of {} channels need about {:.1f} GiB of memory and "
                           "{:.1f} GiB are available; leave channels out or make it smaller",
                           size.width_px, size.height_px, file_.names().size(),
                           static_cast<double>(needed) / gibibyte,
                           static_cast<double>(memory_bytes) / gibibyte));
    }
}

std::string CaseImageFile::find(const std::vector<std::string>& names, std::string_view suffix)
{
    for (const std::string& name : names) {
        if (file_.has(fmt::format("{}{}", name, suffix))) {
            return name;
        }
    }
    return {};
}

std::optional<std::array<std::string, 3>>
CaseImageFile::find_vector(const std::vector<std::string>& names)
{
    constexpr std::array<std::array<std::string_view, 3>, 3> endings{
        {{".X", ".Y", ".Z"}, {".R", ".G", ".B"}, {".x", ".y", ".z"}}};
    for (const auto& ending : endings) {
        if (const std::string name = find(names, ending[0]); !name.empty()) {
            return std::array{fmt::format("{}{}", name, ending[0]),
                              fmt::format("{}{}", name, ending[1]),
                              fmt::format("{}{}", name, ending[2])};
        }
    }
    return std::nullopt;
}

scene::Image<float> CaseImageFile::numbers(const std::string& name)
{
    require(name);
    return file_.numbers(name);
}

scene::Image<float> CaseImageFile::exact_numbers(const std::string& name,
                                                 std::string_view why_not_half)
{
    require(name);
    if (file_.type(name) != LayerType::float32) {
        refuse(
            fmt::format("channel {} is not 32-bit float: {}", scene::one_line(name), why_not_half));
    }
    return file_.floats(name);
}

scene::Image<std::uint32_t> CaseImageFile::whole_numbers(const std::string& name,
                                                         const scene::Image<Vec3f>& position)
{
    if (file_.type(name) == LayerType::uint32) {
        return file_.integers(name);
    }
    const scene::Image<float> from = numbers(name);
    scene::Image<std::uint32_t> result{size(), std::numeric_limits<std::uint32_t>::max()};
    for (std::size_t i = 0; i < from.pixel_count(); ++i) {
        if (std::isnan(position[i].x)) {
            continue;
        }
        constexpr float beyond_whole = 16777216; // 2^24: float32 skips whole numbers above
        if (!(from[i] >= 0 && from[i] <= beyond_whole && from[i] == std::floor(from[i]))) {
            refuse_pixel(fmt::format("{} = {}", scene::one_line(name), from[i]), i,
                         "an object's number is a whole number from 0 to 16777216, or write "
                         "the channel as uint");
        }
        result[i] = static_cast<std::uint32_t>(from[i]);
    }
    return result;
}

void CaseImageFile::refuse(const std::string& what) const
{
    throw scene::InputError(fmt::format("{}: {}", name_, what));
}

void CaseImageFile::refuse_pixel(std::string_view what, std::size_t pixel,
                                 std::string_view remedy) const
{
    const auto width = static_cast<std::size_t>(size().width_px);
    refuse(fmt::format("{} at pixel ({}, {}): {}", what, pixel % width, pixel / width, remedy));
}

std::string CaseImageFile::listing()
{
    std::vector<std::string> names = file_.names();
    const bool is_long = names.size() > 12;
    names.resize(std::min<std::size_t>(names.size(), 12));
    return scene::one_line(
        fmt::format("it has {}{}", fmt::join(names, ", "), is_long ? ", …" : ""));
}

void CaseImageFile::refuse_encoding()
{
    constexpr std::array<std::string_view, 5> lossy{"pxr24", "b44", "b44a", "dwaa", "dwab"};
    if (const std::string used = file_.compression();
        std::ranges::find(lossy, used) != lossy.end()) {
        refuse(fmt::format("compressed with {}, which changes numbers: write it with zip, zips, "
                           "piz, rle or without compression",
                           used));
    }
    if (!file_.is_whole_display()) {
        refuse("the data window is not the display window: write the whole image, uncropped "
               "and without overscan");
    }
}

void CaseImageFile::require(const std::string& name)
{
    const LayerType type = file_.type(name);
    if (type == LayerType::missing) {
        refuse(fmt::format("no channel {}: {}", scene::one_line(name), listing()));
    }
    if (type == LayerType::other) {
        refuse(fmt::format("channel {} is neither half, float nor uint: write it as one",
                           scene::one_line(name)));
    }
}

} // namespace gnomon::store
