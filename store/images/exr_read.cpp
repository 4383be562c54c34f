#include "store/images/exr.hpp"
#include "store/images/exr_threads.hpp"

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <exception>
#include <string_view>
#include <utility>

namespace gnomon::store {

namespace {

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
    /// Whether the pixels are sound.
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

} // namespace gnomon::store
