#include "exr_layers.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <bit>

namespace gnomon::store {

namespace {

ExrLayers read_part(Imf::InputPart part)
{
    const Imf::Header& header = part.header();
    const Imath::Box2i& window = header.dataWindow();
    ExrLayers layers;
    layers.name = header.hasName() ? header.name() : "";
    layers.width_px = window.max.x + 1;
    layers.height_px = window.max.y + 1;
    layers.compression = header.compression() == Imf::ZIP_COMPRESSION ? "zip" : "another";
    Imf::FrameBuffer buffer;
    for (auto entry = header.channels().begin(); entry != header.channels().end(); ++entry) {
        auto& bits = layers.channels[entry.name()];
        bits.resize(static_cast<std::size_t>(layers.width_px) *
                    static_cast<std::size_t>(layers.height_px));
        layers.is_float[entry.name()] = entry.channel().type == Imf::FLOAT;
        buffer.insert(entry.name(), Imf::Slice::Make(entry.channel().type, bits.data(), window, 4));
    }
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    for (auto entry = header.begin(); entry != header.end(); ++entry) {
        if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute())) {
            layers.texts[entry.name()] = text->value();
        }
    }
    return layers;
}

} // namespace

float ExrLayers::value(const std::string& channel, std::size_t pixel) const
{
    return std::bit_cast<float>(channels.at(channel)[pixel]);
}

std::vector<ExrLayers> read_exr_parts(const std::filesystem::path& path)
{
    Imf::MultiPartInputFile file{path.c_str()};
    std::vector<ExrLayers> parts;
    for (int i = 0; i < file.parts(); ++i) {
        parts.push_back(read_part({file, i}));
    }
    return parts;
}

ExrLayers read_exr(const std::filesystem::path& path)
{
    return read_exr_parts(path).front();
}

} // namespace gnomon::store
