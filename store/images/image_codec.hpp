#pragma once

#include "scene/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
    std::string name = {}; ///< of several
};

/// How the numbers of a channel are kept in a file.
enum class LayerType : std::uint8_t { missing, float16, float32, uint32, other };

/// What an EXR file says of itself.
struct ExrHeader {
    struct Channel {
        std::string name;
        LayerType type = LayerType::other;
        std::size_t offset_bytes = 0; ///< in a decoded pixel
    };

    scene::ImageSize size;
    bool is_flat = false;          ///< one layer of scanlines that begin at (0, 0)
    bool is_whole_display = false; ///< the display window is the data window
    std::vector<Channel> channels;
    std::size_t pixel_bytes = 0;
    std::uint64_t decoded_bytes = 0; ///< of all pixels
    std::string compression;         ///< "zip", "dwaa:45", …; empty: not said
    std::map<std::string, std::string> texts;
};

/// An open EXR file.
class ExrInput {
public:
    ExrInput() = default;
    ExrInput(const ExrInput&) = delete;
    ExrInput& operator=(const ExrInput&) = delete;
    virtual ~ExrInput() = default;
    [[nodiscard]] virtual const ExrHeader& header() const = 0;
    /// All pixels, each as its channels' own bytes one after the other; none if they are damaged.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> decoded() = 0;
};

/// A line of text and how it looks.
struct TextLine {
    std::string text; ///< ASCII
    int size_px = 16;
    std::string font_file;
};

/// What is asked of OpenImageIO: its library brings some 250 others along, whose loading takes
/// longer than a small comparison, so that programs may open it when an image is first read or
/// written.
class ImageCodec {
public:
    ImageCodec() = default;
    ImageCodec(const ImageCodec&) = delete;
    ImageCodec& operator=(const ImageCodec&) = delete;
    virtual ~ImageCodec() = default;

    /// @param samples  8-bit, interleaved, row by row: 1 or 3 a pixel.
    /// @throws scene::EnvironmentError  if the encoder fails.
    [[nodiscard]] virtual std::vector<std::byte>
    encode_png(scene::ImageSize size, int channel_count, const std::uint8_t* samples) const = 0;
    /// ZIP-compressed scanlines; no time stamp, so that equal input gives equal bytes.
    /// @param parts  at least one; several have names.
    /// @throws scene::EnvironmentError  if the encoder fails.
    [[nodiscard]] virtual std::vector<std::byte>
    encode_exr(std::span<const ExrPart> parts) const = 0;

    /// The grey values of a PNG file of one 8-bit channel and the given size.
    /// @throws scene::InputError  saying what is wrong, without the file's name.
    [[nodiscard]] virtual scene::Image<std::uint8_t>
    decode_grey_png(std::string_view bytes, scene::ImageSize size) const = 0;
    /// @return  null if the header is damaged.
    /// @throws scene::EnvironmentError  if there is no reader of EXR files.
    [[nodiscard]] virtual std::unique_ptr<ExrInput>
    open_exr(const std::filesystem::path& path) const = 0;
    [[nodiscard]] virtual scene::Image<float>
    floats_of(const scene::Image<std::uint16_t>& halves) const = 0;

    /// Draws over 8-bit RGB samples; the baseline begins at (left, baseline).
    /// @param colour  RGB, each in [0, 1].
    /// @throws scene::EnvironmentError  if the font cannot be drawn.
    virtual void draw(const TextLine& line, int left, int baseline,
                      const std::array<float, 3>& colour, scene::ImageSize size,
                      std::uint8_t* samples) const = 0;
    /// Advance of the line [px]; 0 without glyphs.
    [[nodiscard]] virtual int width_px(const TextLine& line) const = 0;
};

/// The process's codec: OpenImageIO as it is linked, or loaded on demand (see
/// store/CMakeLists.txt).
/// @throws scene::EnvironmentError  if it cannot be loaded.
[[nodiscard]] const ImageCodec& image_codec();

/// OpenImageIO itself.
[[nodiscard]] const ImageCodec& openimageio_codec();

} // namespace gnomon::store
