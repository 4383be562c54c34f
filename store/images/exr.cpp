#include "store/images/exr.hpp"

#include "scene/error.hpp"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <string_view>
#include <thread>
#include <utility>

namespace gnomon::store {

namespace {

/// How many threads OpenEXR takes for an image. A small one is done before threads have started.
/// @param bytes  of the pixels, or of the file.
int exr_threads(std::uint64_t bytes)
{
    constexpr std::uint64_t small_bytes = 1U << 20;
    if (bytes < small_bytes) {
        return 0;
    }
    static const int threads = [] {
        const int cores = static_cast<int>(std::thread::hardware_concurrency());
        try {
            Imf::setGlobalThreadCount(cores);
        } catch (const std::exception&) { // threads are limited: continue without
            return 0;
        }
        return cores;
    }();
    return threads;
}

std::string_view compression_name(Imf::Compression compression)
{
    switch (compression) {
    case Imf::NO_COMPRESSION:
        return "none";
    case Imf::RLE_COMPRESSION:
        return "rle";
    case Imf::ZIPS_COMPRESSION:
        return "zips";
    case Imf::ZIP_COMPRESSION:
        return "zip";
    case Imf::PIZ_COMPRESSION:
        return "piz";
    case Imf::PXR24_COMPRESSION:
        return "pxr24";
    case Imf::B44_COMPRESSION:
        return "b44";
    case Imf::B44A_COMPRESSION:
        return "b44a";
    case Imf::DWAA_COMPRESSION:
        return "dwaa";
    case Imf::DWAB_COMPRESSION:
        return "dwab";
    default:
        return "";
    }
}

std::pair<LayerType, std::size_t> type_and_bytes(Imf::PixelType type)
{
    switch (type) {
    case Imf::HALF:
        return {LayerType::float16, 2};
    case Imf::FLOAT:
        return {LayerType::float32, 4};
    default:
        return {LayerType::uint32, 4};
    }
}

std::map<std::string, std::string> texts_of(const Imf::Header& header)
{
    std::map<std::string, std::string> texts;
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute())) {
            texts.emplace(entry.name(), text->value());
        }
    }
    return texts;
}

ExrHeader file_header(const Imf::Header& file)
{
    ExrHeader header;
    const Imath::Box2i& window = file.dataWindow();
    header.size = {window.max.x - window.min.x + 1, window.max.y - window.min.y + 1};
    header.is_whole_display = file.displayWindow() == window;
    for (auto entry = file.channels().begin(); entry != file.channels().end(); ++entry) {
        const Imf::Channel& channel = entry.channel();
        header.is_subsampled |= channel.xSampling != 1 || channel.ySampling != 1;
        const auto [type, bytes] = type_and_bytes(channel.type);
        header.channels.push_back({entry.name(), type, header.pixel_bytes});
        header.pixel_bytes += bytes;
    }
    header.compression = compression_name(file.compression());
    header.texts = texts_of(file);
    return header;
}

class OpenExrFile final : public ExrInput {
public:
    explicit OpenExrFile(const std::filesystem::path& path)
        : file_{path.c_str(), exr_threads(std::filesystem::file_size(path))},
          header_{file_header(file_.header())}
    {
    }

    [[nodiscard]] const ExrHeader& header() const override { return header_; }
    [[nodiscard]] std::optional<std::vector<std::byte>> decoded() override
    {
        std::vector<std::byte> pixels(header_.decoded_bytes());
        if (!read(pixels)) {
            return std::nullopt;
        }
        return pixels;
    }

private:
    /// False if the pixels are damaged.
    bool read(std::vector<std::byte>& pixels)
    try {
        const Imath::Box2i& window = file_.header().dataWindow();
        Imf::FrameBuffer buffer;
        for (const ExrHeader::Channel& channel : header_.channels) {
            buffer.insert(channel.name,
                          Imf::Slice::Make(file_.header().channels()[channel.name].type,
                                           pixels.data() + channel.offset_bytes, window,
                                           header_.pixel_bytes));
        }
        file_.setFrameBuffer(buffer);
        file_.readPixels(window.min.y, window.max.y);
        return true;
    } catch (const std::exception&) {
        return false;
    }

    Imf::InputFile file_;
    ExrHeader header_;
};

/// Collects the bytes of a file in memory.
class MemoryStream final : public Imf::OStream {
public:
    MemoryStream() : OStream{"EXR"} {}

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
    constexpr int rows_at_once = 128; // limits the memory for the channels' bits
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

std::uint64_t ExrHeader::decoded_bytes() const
{
    return static_cast<std::uint64_t>(size.width_px) * static_cast<std::uint64_t>(size.height_px) *
           pixel_bytes;
}

std::unique_ptr<ExrInput> open_exr(const std::filesystem::path& path)
{
    try {
        return std::make_unique<OpenExrFile>(path);
    } catch (const std::exception&) {
        return nullptr;
    }
}

scene::Image<float> floats_of(const scene::Image<std::uint16_t>& halves)
{
    scene::Image<float> floats{halves.size()};
    std::ranges::transform(halves, floats.data(), [](std::uint16_t bits) {
        Imath::half half;
        half.setBits(bits);
        return static_cast<float>(half);
    });
    return floats;
}

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
        MemoryStream memory;
        {
            Imf::MultiPartOutputFile file{memory, headers.data(), static_cast<int>(headers.size()),
                                          false, exr_threads(pixel_bytes(parts))};
            for (std::size_t i = 0; i < parts.size(); ++i) {
                Imf::OutputPart output{file, static_cast<int>(i)};
                write_pixels(output, parts[i]);
            }
        } // the destructor writes the line table
        return memory.take();
    } catch (const std::exception& error) {
        throw scene::EnvironmentError(
            fmt::format("OpenEXR failed to encode an image of {} × {} pixels: {}; make it smaller",
                        parts.front().size.width_px, parts.front().size.height_px, error.what()));
    }
}

} // namespace gnomon::store
