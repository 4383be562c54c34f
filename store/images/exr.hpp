#pragma once

#include "scene/image.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::store {

enum class ChannelType : std::uint8_t { float32, uint32 };

/// A channel of an EXR file to write.
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

/// An image of an EXR file to write.
struct ExrPart {
    scene::ImageSize size;
    std::span<const ExrChannel> channels;
    std::span<const ExrAttribute> attributes;
    std::string name = {}; ///< required if the file has several parts
};

/// Encodes ZIP-compressed scanlines without a time stamp, so equal input gives equal bytes.
/// @throws scene::EnvironmentError  if the encoder fails.
[[nodiscard]] std::vector<std::byte> encode_exr(scene::ImageSize size,
                                                std::span<const ExrChannel> channels,
                                                std::span<const ExrAttribute> attributes);
/// Encodes several images into one file.
/// @param parts  at least one.
[[nodiscard]] std::vector<std::byte> encode_exr(std::span<const ExrPart> parts);

/// The number type of a channel in a file.
enum class LayerType : std::uint8_t { missing, float16, float32, uint32 };

/// The header of a scanline EXR file.
struct ExrHeader {
    struct Channel {
        std::string name;
        LayerType type = LayerType::missing;
        std::size_t offset_bytes = 0; ///< in a decoded pixel
    };

    scene::ImageSize size;
    bool is_whole_display = false; ///< the display window is the data window
    bool is_subsampled = false;    ///< a channel lacks values for some pixels
    std::vector<Channel> channels;
    std::size_t pixel_bytes = 0;
    std::string compression; ///< "zip", "dwaa", …; empty: unknown
    std::map<std::string, std::string> texts;

    /// Size of all pixels.
    [[nodiscard]] std::uint64_t decoded_bytes() const;
};

/// An open EXR file.
class ExrInput {
public:
    ExrInput() = default;
    ExrInput(const ExrInput&) = delete;
    ExrInput& operator=(const ExrInput&) = delete;
    virtual ~ExrInput() = default;
    [[nodiscard]] virtual const ExrHeader& header() const = 0;
    /// All pixels, with the bytes of all channels interleaved; empty if the file is damaged.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> decoded() = 0;
};

/// Opens a file with one part of scanlines; null if the header is damaged.
[[nodiscard]] std::unique_ptr<ExrInput> open_exr(const std::filesystem::path& path);

[[nodiscard]] scene::Image<float> floats_of(const scene::Image<std::uint16_t>& halves);

} // namespace gnomon::store
