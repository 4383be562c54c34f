#include "scene/error.hpp"
#include "store/images/image_codec.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include <cstdlib>
#include <unistd.h>

namespace gnomon::store {

namespace {

/// An OpenImageIO writer.
class Output {
public:
    /// @param name  a file name whose extension selects the format.
    explicit Output(const std::string& name) : output_{OIIO::ImageOutput::create(name)}
    {
        if (output_ == nullptr) {
            throw scene::EnvironmentError(
                fmt::format("OpenImageIO cannot write {}: {}; install OpenImageIO with its plugins",
                            name, OIIO::geterror()));
        }
    }

    [[nodiscard]] OIIO::ImageOutput* operator->() const { return output_.get(); }

    void write_rows(int first, int last, const OIIO::TypeDesc& type, const void* rows) const
    {
        require("write_scanlines", output_->write_scanlines(first, last, 0, type, rows));
    }
    void require(std::string_view call, bool succeeded) const
    {
        if (!succeeded) {
            throw scene::EnvironmentError(fmt::format("OpenImageIO failed to encode {}: {}: {}; "
                                                      "check its version with `gnomon doctor`",
                                                      output_->format_name(), call,
                                                      output_->geterror()));
        }
    }

private:
    std::unique_ptr<OIIO::ImageOutput> output_;
};

/// Writes one image into memory.
/// @param name   whose extension selects the format; nothing of that name is made.
/// @param write  writes the image's rows.
template <typename Write>
std::vector<std::byte> encode_image(const std::string& name, const OIIO::ImageSpec& spec,
                                    const Write& write)
{
    OIIO::Filesystem::IOVecOutput memory; // outlives the writer that points to it
    const Output output{name};
    output.require("open", output->set_ioproxy(&memory) && output->open(name, spec));
    write(output);
    output.require("close", output->close());
    const auto bytes = std::as_bytes(std::span{memory.buffer()});
    return {bytes.begin(), bytes.end()};
}

/// A file of a name of its own that is gone with it.
class ScratchFile {
public:
    /// @throws scene::EnvironmentError  if it cannot be made.
    explicit ScratchFile(std::string_view extension)
    {
        std::error_code error;
        path_ = (std::filesystem::temp_directory_path(error) / "gnomon-XXXXXX").string();
        path_ += extension;
        const int file = ::mkstemps(path_.data(), static_cast<int>(extension.size()));
        if (file < 0) {
            throw scene::EnvironmentError(
                fmt::format("{}: {}; free space there, or set TMPDIR to another folder", path_,
                            std::generic_category().message(errno)));
        }
        ::close(file);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    ~ScratchFile() { ::unlink(path_.c_str()); }

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] std::vector<std::byte> bytes() const
    {
        std::error_code error;
        std::vector<std::byte> all(std::filesystem::file_size(path_, error));
        std::ifstream file{path_, std::ios::binary};
        file.read(reinterpret_cast<char*>(all.data()), static_cast<std::streamsize>(all.size()));
        if (error || !file) {
            throw scene::EnvironmentError(
                fmt::format("{}: cannot be read again; free space there", path_));
        }
        return all;
    }

private:
    std::string path_;
};

OIIO::ImageSpec exr_spec(const ExrPart& part)
{
    OIIO::ImageSpec spec{part.size.width_px, part.size.height_px,
                         static_cast<int>(part.channels.size()), OIIO::TypeDesc::FLOAT};
    spec.channelnames.clear();
    for (const ExrChannel& channel : part.channels) {
        spec.channelnames.push_back(channel.name);
        spec.channelformats.emplace_back(
            channel.type == ChannelType::float32 ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT32);
    }
    spec.attribute("compression", "zip");
    // Left out, the writer would put the current time here.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    if (!part.name.empty()) {
        spec.attribute("oiio:subimagename", part.name);
    }
    for (const ExrAttribute& attribute : part.attributes) {
        spec.attribute(attribute.name, attribute.value);
    }
    return spec;
}

void write_part(const Output& output, const ExrPart& part)
{
    constexpr int rows_at_once = 128; // bounds the memory that interleaving takes
    const auto& channels = part.channels;
    const auto width = static_cast<std::size_t>(part.size.width_px);
    std::vector<std::uint32_t> rows;
    for (int first = 0; first < part.size.height_px; first += rows_at_once) {
        const int last = std::min(first + rows_at_once, part.size.height_px);
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
}

/// Several images in one file, which OpenImageIO writes to no memory.
std::vector<std::byte> encode_parts(std::span<const ExrPart> parts)
{
    const ScratchFile file{".exr"};
    std::vector<OIIO::ImageSpec> specs(parts.size());
    std::ranges::transform(parts, specs.begin(), exr_spec);
    const Output output{file.path()};
    output.require("open", output->open(file.path(), static_cast<int>(specs.size()), specs.data()));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i > 0) {
            output.require("open",
                           output->open(file.path(), specs[i], OIIO::ImageOutput::AppendSubimage));
        }
        write_part(output, parts[i]);
    }
    output.require("close", output->close());
    return file.bytes();
}

LayerType layer_type(const OIIO::TypeDesc& type)
{
    return type == OIIO::TypeDesc::FLOAT    ? LayerType::float32
           : type == OIIO::TypeDesc::HALF   ? LayerType::float16
           : type == OIIO::TypeDesc::UINT32 ? LayerType::uint32
                                            : LayerType::other;
}

std::map<std::string, std::string> header_texts(const OIIO::ImageSpec& spec)
{
    std::map<std::string, std::string> texts;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeDesc::STRING) {
            texts.emplace(std::string{attribute.name().data(), attribute.name().size()},
                          attribute.get_string());
        }
    }
    return texts;
}

ExrHeader exr_header(const OIIO::ImageSpec& spec)
{
    ExrHeader header;
    header.size = {spec.width, spec.height};
    header.is_flat =
        spec.depth == 1 && spec.x == 0 && spec.y == 0 && !spec.deep && spec.tile_width == 0;
    header.is_whole_display = spec.full_x == 0 && spec.full_y == 0 &&
                              spec.full_width == spec.width && spec.full_height == spec.height;
    std::size_t offset_bytes = 0;
    for (int i = 0; i < spec.nchannels; ++i) {
        const OIIO::TypeDesc type = spec.channelformat(i);
        header.channels.push_back({spec.channel_name(i), layer_type(type), offset_bytes});
        offset_bytes += type.size();
    }
    header.pixel_bytes = spec.pixel_bytes(true);
    header.decoded_bytes = spec.image_bytes(true);
    header.compression = spec.get_string_attribute("compression");
    header.texts = header_texts(spec);
    return header;
}

class OpenImageIoExr final : public ExrInput {
public:
    OpenImageIoExr(std::unique_ptr<OIIO::ImageInput> input, const OIIO::ImageSpec& spec)
        : input_{std::move(input)},
          header_{exr_header(spec)}
    {
    }

    [[nodiscard]] const ExrHeader& header() const override { return header_; }
    [[nodiscard]] std::optional<std::vector<std::byte>> decoded() override
    {
        std::vector<std::byte> pixels(header_.decoded_bytes);
        const bool is_read = input_->read_scanlines(0, 0, 0, header_.size.height_px, 0, 0,
                                                    static_cast<int>(header_.channels.size()),
                                                    OIIO::TypeDesc::UNKNOWN, pixels.data());
        return is_read ? std::optional{std::move(pixels)} : std::nullopt;
    }

private:
    std::unique_ptr<OIIO::ImageInput> input_;
    ExrHeader header_;
};

class OpenImageIoCodec final : public ImageCodec {
public:
    [[nodiscard]] std::vector<std::byte> encode_png(scene::ImageSize size, int channel_count,
                                                    const std::uint8_t* samples) const override
    {
        const OIIO::ImageSpec spec{size.width_px, size.height_px, channel_count,
                                   OIIO::TypeDesc::UINT8};
        return encode_image("picture.png", spec, [&](const Output& output) {
            output.write_rows(0, size.height_px, OIIO::TypeDesc::UINT8, samples);
        });
    }

    [[nodiscard]] std::vector<std::byte> encode_exr(std::span<const ExrPart> parts) const override
    {
        if (parts.size() == 1) {
            return encode_image("layers.exr", exr_spec(parts.front()),
                                [&](const Output& output) { write_part(output, parts.front()); });
        }
        return encode_parts(parts);
    }

    [[nodiscard]] scene::Image<std::uint8_t> decode_grey_png(std::string_view bytes,
                                                             scene::ImageSize size) const override
    {
        OIIO::Filesystem::IOMemReader memory{bytes.data(), bytes.size()};
        const auto input = OIIO::ImageInput::create("png");
        OIIO::ImageSpec spec;
        if (input == nullptr || !input->set_ioproxy(&memory) || !input->open("grey.png", spec)) {
            throw scene::InputError("no PNG image, or damaged");
        }
        if (spec.width != size.width_px || spec.height != size.height_px || spec.nchannels != 1 ||
            spec.format != OIIO::TypeDesc::UINT8) {
            throw scene::InputError("no image of one grey channel with 8 bits");
        }
        scene::Image<std::uint8_t> grey{size};
        if (!input->read_scanlines(0, 0, 0, size.height_px, 0, 0, 1, OIIO::TypeDesc::UINT8,
                                   grey.data())) {
            throw scene::InputError("damaged or truncated");
        }
        return grey;
    }

    [[nodiscard]] std::unique_ptr<ExrInput>
    open_exr(const std::filesystem::path& path) const override
    {
        auto input = OIIO::ImageInput::create("openexr");
        if (input == nullptr) {
            throw scene::EnvironmentError(
                fmt::format("OpenImageIO cannot read EXR: {}; install OpenImageIO with its plugins",
                            OIIO::geterror()));
        }
        OIIO::ImageSpec spec;
        if (!input->open(path.string(), spec)) {
            return nullptr;
        }
        return std::make_unique<OpenImageIoExr>(std::move(input), spec);
    }

    [[nodiscard]] scene::Image<float>
    floats_of(const scene::Image<std::uint16_t>& halves) const override
    {
        scene::Image<float> floats{halves.size()};
        OIIO::convert_pixel_values(OIIO::TypeDesc::HALF, halves.data(), OIIO::TypeDesc::FLOAT,
                                   floats.data(), static_cast<int>(floats.pixel_count()));
        return floats;
    }

    void draw(const TextLine& line, int left, int baseline, const std::array<float, 3>& colour,
              scene::ImageSize size, std::uint8_t* samples) const override
    {
        OIIO::ImageBuf buffer{
            OIIO::ImageSpec{size.width_px, size.height_px, 3, OIIO::TypeDesc::UINT8}, samples};
        if (!OIIO::ImageBufAlgo::render_text(buffer, left, baseline, line.text, line.size_px,
                                             line.font_file, colour)) {
            throw scene::EnvironmentError(
                fmt::format("OpenImageIO failed to write text with {}: {}; it must be built with "
                            "FreeType",
                            line.font_file, buffer.geterror()));
        }
    }

    [[nodiscard]] int width_px(const TextLine& line) const override
    {
        const OIIO::ROI extent =
            OIIO::ImageBufAlgo::text_size(line.text, line.size_px, line.font_file);
        // Of a text without glyphs OpenImageIO gives a box that is inside out.
        return std::max(extent.xend, 0);
    }
};

} // namespace

const ImageCodec& openimageio_codec()
{
    static const OpenImageIoCodec codec;
    return codec;
}

} // namespace gnomon::store
