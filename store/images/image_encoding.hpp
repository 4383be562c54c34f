#pragma once

#include "store/images/image_codec.hpp"

namespace gnomon::store {

/// An sRGB colour.
struct Rgb {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    friend bool operator==(const Rgb&, const Rgb&) = default;
};
using RgbImage = scene::Image<Rgb>;

/// The image's samples, red, green, blue, pixel by pixel.
[[nodiscard]] std::uint8_t* samples_of(RgbImage& image);

/// Encodes in memory, so that writing the file is left to `OutputFile`, which loses no error.
/// @throws scene::EnvironmentError  if the encoder fails.
[[nodiscard]] std::vector<std::byte> encode_png(const RgbImage& image);
/// One grey channel.
[[nodiscard]] std::vector<std::byte> encode_png(const scene::Image<std::uint8_t>& grey);

/// ZIP-compressed scanlines; no time stamp, so that equal input gives equal bytes.
/// @throws scene::EnvironmentError  if the encoder fails.
[[nodiscard]] std::vector<std::byte> encode_exr(scene::ImageSize size,
                                                std::span<const ExrChannel> channels,
                                                std::span<const ExrAttribute> attributes);
/// The same of several images in one file.
[[nodiscard]] std::vector<std::byte> encode_exr(std::span<const ExrPart> parts);

} // namespace gnomon::store
