#pragma once

#include "scene/image.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::store {

/// An sRGB colour.
struct Rgb {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    friend bool operator==(const Rgb&, const Rgb&) = default;
};
using RgbImage = scene::Image<Rgb>;

/// Encodes in memory; `OutputFile` writes the file and reports all errors.
/// @throws scene::EnvironmentError  if the encoder fails.
[[nodiscard]] std::vector<std::byte> encode_png(const RgbImage& image);
/// As above, with one grey channel.
[[nodiscard]] std::vector<std::byte> encode_png(const scene::Image<std::uint8_t>& grey);

/// Decodes a PNG file with one 8-bit grey channel and the given size.
/// @throws scene::InputError  with the fault, but without the file's name.
[[nodiscard]] scene::Image<std::uint8_t> decode_grey_png(std::string_view bytes,
                                                         scene::ImageSize size);

} // namespace gnomon::store
