#include "reports/image_encoding.hpp"

#include "scene/error.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace gnomon::reports {

namespace {

/// An OpenImageIO writer into memory.
class MemoryOutput {
public:
    /// @param name  a file name whose extension selects the format; nothing of that name is made.
    MemoryOutput(const std::string& name, const OIIO::ImageSpec& spec)
        : output_{OIIO::ImageOutput::create(name)}
    {
        if (output_ == nullptr) {
            throw scene::EnvironmentError(
                fmt::format("OpenImageIO cannot write {}: {}; install OpenImageIO with its plugins",
                            name, OIIO::geterror()));
        }
        require("open", output_->set_ioproxy(&memory_) && output_->open(name, spec));
    }

    void write_rows(int first, int last, const OIIO::TypeDesc& type, const void* rows)
    {
        require("write_scanlines", output_->write_scanlines(first, last, 0, type, rows));
    }

    [[nodiscard]] std::vector<std::byte> take()
    {
        require("close", output_->close());
        const auto bytes = std::as_bytes(std::span{memory_.buffer()});
        return {bytes.begin(), bytes.end()};
    }

private:
    void require(std::string_view call, bool succeeded) const
    {
        if (!succeeded) {
            throw scene::EnvironmentError(fmt::format("OpenImageIO failed to encode {}: {}: {}; "
                                                      "check its version with `gnomon doctor`",
                                                      output_->format_name(), call,
                                                      output_->geterror()));
        }
    }

    OIIO::Filesystem::IOVecOutput memory_; // outlives the writer that points to it
    std::unique_ptr<OIIO::ImageOutput> output_;
};

OIIO::ImageSpec exr_spec(scene::ImageSize size, std::span<const ExrChannel> channels,
                         std::span<const ExrAttribute> attributes)
{
    OIIO::ImageSpec spec{size.width_px, size.height_px, static_cast<int>(channels.size()),
                         OIIO::TypeDesc::FLOAT};
    spec.channelnames.clear();
    for (const ExrChannel& channel : channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.emplace_back(
            channel.type == ChannelType::float32 ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT32);
    }
    spec.attribute("compression", "zip");
    // Left out, the writer would put the current time here.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    for (const ExrAttribute& attribute : attributes) {
        spec.attribute(attribute.name, attribute.value);
    }
    return spec;
}

} // namespace

std::vector<std::byte> encode_png(const RgbImage& image)
{
    static_assert(sizeof(Rgb) == 3, "pixels are packed as the encoder expects them");
    const auto [width_px, height_px] = image.size();
    MemoryOutput output{"picture.png",
                        OIIO::ImageSpec{width_px, height_px, 3, OIIO::TypeDesc::UINT8}};
    output.write_rows(0, height_px, OIIO::TypeDesc::UINT8, image.data());
    return output.take();
}

std::vector<std::byte> encode_png(const scene::Image<std::uint8_t>& grey)
{
    const auto [width_px, height_px] = grey.size();
    MemoryOutput output{"mask.png", OIIO::ImageSpec{width_px, height_px, 1, OIIO::TypeDesc::UINT8}};
    output.write_rows(0, height_px, OIIO::TypeDesc::UINT8, grey.data());
    return output.take();
}

std::vector<std::byte> encode_exr(scene::ImageSize size, std::span<const ExrChannel> channels,
                                  std::span<const ExrAttribute> attributes)
{
    constexpr int rows_at_once = 128; // bounds the memory that interleaving takes
    MemoryOutput output{"layers.exr", exr_spec(size, channels, attributes)};
    const auto width = static_cast<std::size_t>(size.width_px);
    std::vector<std::uint32_t> rows;
    for (int first = 0; first < size.height_px; first += rows_at_once) {
        const int last = std::min(first + rows_at_once, size.height_px);
        const std::size_t first_pixel = static_cast<std::size_t>(first) * width;
        const std::size_t pixel_count = static_cast<std::size_t>(last - first) * width;
        rows.resize(pixel_count * channels.size());
        for (std::size_t c = 0; c < channels.size(); ++c) {
            for (std::size_t i = 0; i < pixel_count; ++i) {
                rows[i * channels.size() + c] = channels[c].bits(first_pixel + i);
            }
        }
        // UNKNOWN: the values are already in each channel's own type.
        output.write_rows(first, last, OIIO::TypeDesc::UNKNOWN, rows.data());
    }
    return output.take();
}

} // namespace gnomon::reports
