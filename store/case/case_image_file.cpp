#include "store/case/case_image_file.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/images/layer_file.hpp"
#include "store/images/raw_image.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace gnomon::store {

namespace {

constexpr const char* case_advice = "write it as docs/evaluate.md says";

void refuse_encoding(LayerFile& file, const std::string& name)
{
    constexpr std::array<std::string_view, 5> lossy{"pxr24", "b44", "b44a", "dwaa", "dwab"};
    if (const std::string used = file.compression();
        std::ranges::find(lossy, used) != lossy.end()) {
        throw scene::InputError(fmt::format("{}: compressed with {}, which changes numbers: write "
                                            "it with zip, zips, piz, rle or without compression",
                                            name, used));
    }
    if (!file.is_whole_display()) {
        throw scene::InputError(
            fmt::format("{}: the data window is not the display window: write the whole image, "
                        "uncropped and without overscan",
                        name));
    }
}

/// Reverses the order of rows `begin` to `end`.
template <typename Value>
void flip_rows(scene::Image<Value>& image, int begin, int end)
{
    for (int top = begin, low = end - 1; top < low; ++top, --low) {
        for (int x = 0; x < image.size().width_px; ++x) {
            std::swap(image(x, top), image(x, low));
        }
    }
}

/// Flips an image whose lowest row comes first.
template <typename Value>
scene::Image<Value> flipped(scene::Image<Value> image, bool is_bottom_up)
{
    if (is_bottom_up) {
        flip_rows(image, 0, image.size().height_px);
    }
    return image;
}

} // namespace

using scene::ImageSize;
using scene::Vec3f;

CaseImageFile::CaseImageFile(std::span<const scene::CaseImageSource> sources, bool is_bottom_up,
                             std::uint64_t memory_bytes)
{
    for (const scene::CaseImageSource& source : sources) {
        parts_.push_back(open(source, is_bottom_up));
    }
    check_parts();
    check_memory(memory_bytes);
}

CaseImageFile::Part CaseImageFile::open(const scene::CaseImageSource& source, bool is_bottom_up)
{
    std::string name = scene::one_line(source.path.string());
    if (is_raw_image(source.path)) {
        auto raw = std::make_unique<RawImage>(source.path, source.channels, source.least,
                                              std::string{case_advice});
        // The .pfm format fixes the order of rows.
        const bool is_turned = is_bottom_up && !raw->has_own_order();
        return {std::move(name), std::move(raw), is_turned};
    }
    if (source.is_raw_alone) {
        throw scene::InputError(
            fmt::format("{}: {} takes a .npy or a .pfm file; name the channels of an EXR "
                        "file with image and [channels]",
                        name, source.key));
    }
    auto exr = std::make_unique<LayerFile>(source.path, case_advice);
    refuse_encoding(*exr, name);
    return {std::move(name), std::move(exr), is_bottom_up};
}

void CaseImageFile::check_parts()
{
    const ImageSize first = size();
    if (first.pixel_count() > most_image_pixels) {
        refuse(fmt::format("{}x{} pixels; must be at most {}", first.width_px, first.height_px,
                           most_image_pixels));
    }
    std::map<std::string, std::string> owners;
    for (const Part& part : parts_) {
        const ImageSize own = part.file->size();
        if (own != first) {
            throw scene::InputError(fmt::format(
                "{}: {}x{} pixels, but {} has {}x{}: they must show the same frame", part.name,
                own.width_px, own.height_px, parts_.front().name, first.width_px, first.height_px));
        }
        for (const std::string& channel : part.file->names()) {
            const auto [owner, is_new] = owners.emplace(channel, part.name);
            if (!is_new) {
                throw scene::InputError(fmt::format("{}: channel {} is in {} too; keep one",
                                                    part.name, scene::one_line(channel),
                                                    owner->second));
            }
        }
    }
}

void CaseImageFile::check_memory(std::uint64_t memory_bytes)
{
    // The decoded channels, and some 128 bytes a pixel for the layers and the truth.
    std::uint64_t needed = 128 * size().pixel_count();
    std::size_t channels = 0;
    for (const Part& part : parts_) {
        needed += part.file->decoded_bytes();
        channels += part.file->names().size();
    }
    if (memory_bytes != 0 && needed > memory_bytes) {
        constexpr double gibibyte = 1024.0 * 1024.0 * 1024.0;
        refuse(fmt::format("{}x{} pixels of {} channels need about {:.1f} GiB of memory and "
                           "{:.1f} GiB are available; leave channels out or make it smaller",
                           size().width_px, size().height_px, channels,
                           static_cast<double>(needed) / gibibyte,
                           static_cast<double>(memory_bytes) / gibibyte));
    }
}

CaseImageFile::Part* CaseImageFile::part_of(const std::string& name)
{
    const auto found =
        std::ranges::find_if(parts_, [&](const Part& part) { return part.file->has(name); });
    return found == parts_.end() ? nullptr : &*found;
}

std::string CaseImageFile::find(const std::vector<std::string>& names, std::string_view suffix)
{
    for (const std::string& name : names) {
        if (has(fmt::format("{}{}", name, suffix))) {
            return name;
        }
    }
    return {};
}

std::optional<std::array<std::string, 3>>
CaseImageFile::find_vector(const std::vector<std::string>& names)
{
    for (const std::string_view ending : {"XYZ", "RGB", "xyz"}) {
        for (const std::string& name : names) {
            const std::string before = name.empty() ? std::string{} : name + ".";
            if (has(before + ending[0])) {
                return std::array{before + ending[0], before + ending[1], before + ending[2]};
            }
        }
    }
    return std::nullopt;
}

scene::Image<float> CaseImageFile::numbers(const std::string& name)
{
    Part& part = require(name);
    return flipped(part.file->numbers(name), part.is_bottom_up);
}

CaseImageFile::Part& CaseImageFile::require_exact(const std::string& name,
                                                  std::string_view why_not_half)
{
    Part& part = require(name);
    if (part.file->type(name) != LayerType::float32) {
        throw scene::InputError(fmt::format("{}: channel {} is not 32-bit float: {}", part.name,
                                            scene::one_line(name), why_not_half));
    }
    return part;
}

scene::Image<float> CaseImageFile::exact_numbers(const std::string& name,
                                                 std::string_view why_not_half)
{
    const Part& part = require_exact(name, why_not_half);
    return flipped(part.file->floats(name), part.is_bottom_up);
}

scene::Image<float> CaseImageFile::exact_squares(const std::string& name,
                                                 std::string_view why_not_half)
{
    const Part& part = require_exact(name, why_not_half);
    scene::Image<float> squares = part.file->floats(name);
    const auto [side, height] = squares.size();
    for (int begin = 0; part.is_bottom_up && begin < height; begin += side) {
        flip_rows(squares, begin, begin + side);
    }
    return squares;
}

scene::Image<std::uint32_t> CaseImageFile::whole_numbers(const std::string& name,
                                                         const scene::Image<Vec3f>& position)
{
    Part& part = require(name);
    if (part.file->type(name) == LayerType::uint32) {
        return flipped(part.file->integers(name), part.is_bottom_up);
    }
    const scene::Image<float> from = numbers(name);
    scene::Image<std::uint32_t> result{size(), std::numeric_limits<std::uint32_t>::max()};
    for (std::size_t i = 0; i < from.pixel_count(); ++i) {
        if (std::isnan(position[i].x)) {
            continue;
        }
        constexpr float beyond_whole = 16777216; // 2^24: float32 skips whole numbers above
        if (!(from[i] >= 0 && from[i] <= beyond_whole && from[i] == std::floor(from[i]))) {
            refuse_pixel(name, fmt::format("{} = {}", scene::one_line(name), from[i]), i,
                         "an object's number is a whole number from 0 to 16777216, or write "
                         "the channel as uint");
        }
        result[i] = static_cast<std::uint32_t>(from[i]);
    }
    return result;
}

void CaseImageFile::refuse(const std::string& what) const
{
    throw scene::InputError(fmt::format("{}: {}", parts_.front().name, what));
}

void CaseImageFile::refuse_pixel(const std::string& channel, std::string_view what,
                                 std::size_t pixel, std::string_view remedy)
{
    const auto width = static_cast<std::size_t>(size().width_px);
    const Part* const part = part_of(channel);
    throw scene::InputError(fmt::format("{}: {} at pixel ({}, {}): {}",
                                        (part == nullptr ? parts_.front() : *part).name, what,
                                        pixel % width, pixel / width, remedy));
}

std::string CaseImageFile::listing()
{
    std::vector<std::string> names;
    for (const Part& part : parts_) {
        std::ranges::copy(part.file->names(), std::back_inserter(names));
    }
    const bool is_long = names.size() > 12;
    names.resize(std::min<std::size_t>(names.size(), 12));
    return scene::one_line(
        fmt::format("it has {}{}", fmt::join(names, ", "), is_long ? ", …" : ""));
}

CaseImageFile::Part& CaseImageFile::require(const std::string& name)
{
    Part* const part = part_of(name);
    if (part == nullptr) {
        refuse(fmt::format("no channel {}: {}", scene::one_line(name), listing()));
    }
    return *part;
}

} // namespace gnomon::store
