#include "store/baseline/pixel_mask.hpp"

#include "analysis/gate/gate_metrics.hpp"
#include "scene/fnv1a.hpp"
#include "scene/text.hpp"
#include "store/images/png.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <system_error>
#include <vector>

namespace gnomon::store {

namespace fs = std::filesystem;

namespace {

using analysis::PixelMask;

constexpr std::uint64_t most_mask_bytes = std::uint64_t{64} << 20U;
constexpr std::uint8_t wrong_grey = 255;
constexpr std::size_t mask_digits = 16;
constexpr const char* mask_advice = "restore it, or save the baseline again";

fs::path mask_path(const fs::path& baseline, std::string_view name)
{
    return masks_folder(baseline) / fmt::format("{}.png", name);
}

[[noreturn]] void refuse_mask(const fs::path& path, std::string_view problem)
{
    throw scene::InputError(
        fmt::format("{}: {}: {}", scene::one_line(path.string()), problem, mask_advice));
}

std::uint32_t big_endian_word(std::string_view bytes, std::size_t offset)
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = value << 8U | static_cast<unsigned char>(bytes[offset + i]);
    }
    return value;
}

/// The size in a PNG file's header; 0x0 if the bytes do not start with one.
/// Source: ISO/IEC 15948, 5.2 and 11.2.2.
scene::ImageSize png_size(std::string_view bytes)
{
    using namespace std::string_view_literals;
    constexpr std::string_view start = "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"sv;
    if (!bytes.starts_with(start) || bytes.size() < start.size() + 8) {
        return {0, 0};
    }
    const auto number = [&](std::size_t offset) {
        constexpr std::uint32_t largest = 1U << 20U; // far beyond any image
        return static_cast<int>(std::min(big_endian_word(bytes, offset), largest));
    };
    return {number(start.size()), number(start.size() + 4)};
}

/// Whether the file consists of chunks with correct checksums, the last of them IEND. The decoder
/// itself stops at the last pixel. Source: ISO/IEC 15948, 5.3.
bool is_whole_png(std::string_view bytes)
{
    constexpr std::size_t signature_bytes = 8;
    constexpr std::size_t frame_bytes = 12; // length, type and checksum
    std::size_t offset = signature_bytes;
    while (bytes.size() >= offset + frame_bytes) {
        const std::size_t length = big_endian_word(bytes, offset);
        if (length > bytes.size() - offset - frame_bytes) {
            return false;
        }
        const std::string_view summed = bytes.substr(offset + 4, 4 + length);
        const uLong sum = crc32_z(
            0, static_cast<const Bytef*>(static_cast<const void*>(summed.data())), summed.size());
        if (sum != big_endian_word(bytes, offset + 8 + length)) {
            return false;
        }
        offset += frame_bytes + length;
        if (summed.starts_with("IEND")) {
            return offset == bytes.size();
        }
    }
    return false;
}

/// @param size  from the file's header.
PixelMask decoded_mask(const fs::path& path, std::string_view bytes, scene::ImageSize size)
{
    PixelMask mask;
    try {
        mask = decode_grey_png(bytes, size);
    } catch (const scene::InputError& error) {
        refuse_mask(path, error.what());
    }
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        if (mask[i] != 0 && mask[i] != wrong_grey) {
            refuse_mask(path, "has pixels that are neither 0 nor 255");
        }
        mask[i] = mask[i] == 0 ? 0 : 1;
    }
    return mask;
}

} // namespace

fs::path masks_folder(const fs::path& baseline)
{
    fs::path folder = baseline;
    folder += ".masks";
    return folder;
}

std::string mask_name(const PixelMask& mask)
{
    scene::Fnv1a hash;
    hash.add(fmt::format("{}x{}", mask.size().width_px, mask.size().height_px));
    hash.add(mask.data(), mask.pixel_count());
    return fmt::format("{:016x}", hash.value());
}

bool is_mask_name(std::string_view text)
{
    return text.size() == mask_digits &&
           text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::string write_mask(const fs::path& baseline, const PixelMask& mask)
{
    std::string name = mask_name(mask);
    const fs::path path = mask_path(baseline, name);
    make_folder(path.parent_path());
    scene::Image<std::uint8_t> grey{mask.size()};
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        grey[i] = mask[i] == 0 ? 0 : wrong_grey;
    }
    write_file(path, encode_png(grey));
    return name;
}

PixelMask read_mask(const fs::path& baseline, const std::string& name, scene::ImageSize size)
{
    const fs::path path = mask_path(baseline, name);
    std::error_code unknown;
    if (!fs::exists(path, unknown)) {
        throw BaselineMissing(fmt::format("{}: the baseline's mask of wrong pixels is missing: {}",
                                          scene::one_line(path.string()), mask_advice));
    }
    const std::string bytes = scene::read_text_file(path, scene::one_line(path.string()),
                                                    "mask of wrong pixels", most_mask_bytes);
    const scene::ImageSize own = png_size(bytes);
    if (own.width_px < 1 || own.height_px < 1) {
        refuse_mask(path, "not a PNG image, or truncated");
    }
    if (own != size) {
        refuse_mask(path, fmt::format("{}x{} pixels, but the baseline's images are {}x{}",
                                      own.width_px, own.height_px, size.width_px, size.height_px));
    }
    if (!is_whole_png(bytes)) {
        refuse_mask(path, "damaged or truncated");
    }
    PixelMask mask = decoded_mask(path, bytes, size);
    if (mask_name(mask) != name) {
        refuse_mask(path, "its pixels do not match its name");
    }
    return mask;
}

scene::ImageSize image_size_of(const analysis::GateEntry& entry)
{
    const auto side = [&](const char* key) {
        constexpr double largest = 1U << 20U;
        const auto text = entry.setting(key);
        const auto number = text ? analysis::number_in(*text) : std::nullopt;
        if (!number || *number < 1 || *number > largest || std::floor(*number) != *number) {
            throw scene::InputError(
                fmt::format("the baseline's {} is not a number of pixels: save it again", key));
        }
        return static_cast<int>(*number);
    };
    return {side("image.width"), side("image.height")};
}

void require_masks(const fs::path& baseline, const analysis::GateEntries& entries)
{
    for (const analysis::GateEntry& entry : entries.entries) {
        if (!entry.pixels.empty()) {
            const PixelMask mask = read_mask(baseline, entry.pixels, image_size_of(entry));
            const auto wrong = entry.metric(std::string{analysis::wrong_pixels_metric});
            const auto white = static_cast<double>(std::count(mask.begin(), mask.end(), 1));
            if (wrong && *wrong != white) {
                throw scene::InputError(fmt::format(
                    "{}: the mask {} has {} wrong pixels, the configuration's metrics {}: save it "
                    "again with `gnomon baseline save`",
                    scene::one_line(baseline.string()), entry.pixels, white, *wrong));
            }
        }
    }
}

void remove_other_masks(const fs::path& baseline, const analysis::GateEntries& entries)
{
    std::set<std::string> named;
    for (const analysis::GateEntry& entry : entries.entries) {
        named.insert(entry.pixels);
    }
    std::error_code none;
    std::vector<fs::path> others;
    for (const auto& file : fs::directory_iterator{masks_folder(baseline), none}) {
        const std::string stem = file.path().stem().string();
        if (file.path().extension() == ".png" && is_mask_name(stem) && !named.contains(stem)) {
            others.push_back(file.path());
        }
    }
    for (const fs::path& other : others) {
        fs::remove(other, none);
    }
    fs::remove(masks_folder(baseline), none); // only if it is empty
}

} // namespace gnomon::store
