#pragma once

#include "scene/image.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::reports {

/// An sRGB colour.
struct Rgb {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    friend bool operator==(const Rgb&, const Rgb&) = default;
};
using RgbImage = scene::Image<Rgb>;

enum class ChannelType : std::uint8_t { float32, uint32 };

/// A channel of an EXR file.
struct ExrChannel {
    std::string name;
    ChannelType type = ChannelType::float32;
    /// The 32 bits of the channel at a pixel, given by its row-major index.
    std::function<std::uint32_t(std::size_t)> bits;
};

/// A text in an EXR file's header.
struct ExrAttribute {
    std::string name;
    std::string value;
};

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

} // namespace gnomon::reports
