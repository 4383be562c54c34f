#include "scene/error.hpp"
#include "store/images/exr.hpp"
#include "store/images/exr_threads.hpp"

#include <fmt/format.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <utility>

namespace gnomon::store {

namespace {

/// A file in memory.
class Memory final : public Imf::OStream {
public:
    Memory() : OStream{"EXR"} {}

    void write(const char text[], int count) override
    {
        const auto length = static_cast<std::size_t>(count);
        bytes_.resize(std::max(bytes_.size(), at_ + length));
        std::memcpy(bytes_.data() + at_, text, length);
        at_ += length;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
    std::size_t at_ = 0;
};

Imf::PixelType pixel_type(ChannelType type)
{
    return type == ChannelType::float32 ? Imf::FLOAT : Imf::UINT;
}

std::uint64_t pixel_bytes(std::span<const ExrPart> parts)
{
    std::uint64_t bytes = 0;
    for (const ExrPart& part : parts) {
        bytes += sizeof(std::uint32_t) * part.channels.size() *
                 static_cast<std::uint64_t>(part.size.width_px) *
                 static_cast<std::uint64_t>(part.size.height_px);
    }
    return bytes;
}

Imf::Header part_header(const ExrPart& part)
{
    Imf::Header header{part.size.width_px, part.size.height_px};
    header.compression() = Imf::ZIP_COMPRESSION;
    header.setType(Imf::SCANLINEIMAGE);
    if (!part.name.empty()) {
        header.setName(part.name);
    }
    for (const ExrChannel& channel : part.channels) {
        header.channels().insert(channel.name, Imf::Channel{pixel_type(channel.type)});
    }
    for (const ExrAttribute& attribute : part.attributes) {
        header.insert(attribute.name, Imf::StringAttribute{attribute.value});
    }
    return header;
}

void write_pixels(Imf::OutputPart& output, const ExrPart& part)
{
    constexpr int rows_at_once = 128; // bounds the memory that the channels' bits take
    const auto width = static_cast<std::size_t>(part.size.width_px);
    std::vector<std::vector<std::uint32_t>> rows(part.channels.size());
    for (int first = 0; first < part.size.height_px; first += rows_at_once) {
        const int count = std::min(rows_at_once, part.size.height_px - first);
        const std::size_t first_pixel = static_cast<std::size_t>(first) * width;
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < part.channels.size(); ++c) {
            const ExrChannel& channel = part.channels[c];
            rows[c].resize(static_cast<std::size_t>(count) * width);
            for (std::size_t i = 0; i < rows[c].size(); ++i) {
                rows[c][i] = channel.bits(first_pixel + i);
            }
            buffer.insert(channel.name, Imf::Slice::Make(pixel_type(channel.type), rows[c].data(),
                                                         {0, first}, part.size.width_px, count));
        }
        output.setFrameBuffer(buffer);
        output.writePixels(count);
    }
}

} // namespace

std::vector<std::byte> encode_exr(scene::ImageSize size, std::span<const ExrChannel> channels,
                                  std::span<const ExrAttribute> attributes)
{
    const ExrPart part{size, channels, attributes};
    return encode_exr({&part, 1});
}

std::vector<std::byte> encode_exr(std::span<const ExrPart> parts)
{
    try {
        std::vector<Imf::Header> headers(parts.size());
        std::ranges::transform(parts, headers.begin(), part_header);
        Memory memory;
        {
            Imf::MultiPartOutputFile file{memory, headers.data(), static_cast<int>(headers.size()),
                                          false, exr_threads(pixel_bytes(parts))};
            for (std::size_t i = 0; i < parts.size(); ++i) {
                Imf::OutputPart output{file, static_cast<int>(i)};
                write_pixels(output, parts[i]);
            }
        } // writes the table of lines
        return memory.take();
    } catch (const std::exception& error) {
        throw scene::EnvironmentError(
            fmt::format("OpenEXR failed to encode an image of {} × {} pixels: {}; make it smaller",
                        parts.front().size.width_px, parts.front().size.height_px, error.what()));
    }
}

} // namespace gnomon::store
