#include "reports/aov_read.hpp"

#include "scene/error.hpp"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace gnomon::reports {

namespace {

using scene::ImageSize;

constexpr std::string_view rewrite_advice =
    "write it again with `gnomon compare JOB --aov FILE.exr`";

/// Beyond these a header is no AOV's: the longest text is the job, some kilobytes.
constexpr std::size_t longest_name = 255;
constexpr std::size_t largest_attribute_bytes = 1U << 20;
constexpr int most_attributes = 256;
constexpr int most_channels = 64;

[[noreturn]] void refuse_aov(const std::filesystem::path& path, std::string_view what)
{
    throw scene::InputError(fmt::format("{}: {}: {}", path.string(), what, rewrite_advice));
}

/// Reads just enough of an EXR header to know the image's size before the decoder, which takes
/// memory for it, sees the file.
class HeaderScan {
public:
    explicit HeaderScan(const std::filesystem::path& path)
        : path_{path},
          stream_{path, std::ios::binary}
    {
        if (!stream_) {
            refuse_aov(path_, "the file cannot be opened");
        }
    }

    /// @throws scene::InputError  if this is no EXR file of scanlines with a data window.
    [[nodiscard]] ImageSize size()
    {
        constexpr std::uint32_t magic = 20000630;
        constexpr std::uint32_t version = 2;
        constexpr std::uint32_t long_names = 0x400; // the only flag that plain scanlines may have
        if (word() != magic || (word() & ~long_names) != version) {
            refuse_aov(path_, "not an EXR file of plain scanlines");
        }
        std::optional<ImageSize> size;
        for (int i = 0; i < most_attributes; ++i) {
            const std::string name = text();
            if (name.empty()) {
                return size ? *size : throw_no_window();
            }
            const std::string type = text();
            const std::uint32_t bytes = word();
            if (bytes > largest_attribute_bytes) {
                refuse_aov(path_, fmt::format("attribute {} is too large", printable(name)));
            }
            if (name == "dataWindow" && type == "box2i" && bytes == sizeof(Window)) {
                size = window_size();
            } else {
                stream_.ignore(static_cast<std::streamsize>(bytes));
            }
        }
        refuse_aov(path_, "the header has too many attributes");
    }

private:
    using Window = std::array<std::int32_t, 4>; // left, top, right, bottom; inclusive

    [[noreturn]] ImageSize throw_no_window() { refuse_aov(path_, "the header has no data window"); }

    ImageSize window_size()
    {
        Window window{};
        for (std::int32_t& edge : window) {
            edge = static_cast<std::int32_t>(word());
        }
        constexpr std::int32_t largest = 1 << 20; // far beyond any image, and no overflow below
        const auto [left, top, right, bottom] = window;
        if (left != 0 || top != 0 || right < 0 || bottom < 0 || right > largest ||
            bottom > largest) {
            refuse_aov(path_, "the data window is not an image's");
        }
        return {right + 1, bottom + 1};
    }

    char byte()
    {
        const int value = stream_.get();
        if (value == std::char_traits<char>::eof()) {
            refuse_aov(path_, "the header ends too early");
        }
        return static_cast<char>(value);
    }
    /// EXR is little-endian.
    std::uint32_t word()
    {
        std::uint32_t value = 0;
        for (unsigned shift = 0; shift < 32; shift += 8) {
            value |= std::uint32_t{static_cast<unsigned char>(byte())} << shift;
        }
        return value;
    }
    std::string text()
    {
        std::string result;
        for (char c = byte(); c != '\0'; c = byte()) {
            if (result.size() == longest_name) {
                refuse_aov(path_, "a name in the header is too long");
            }
            result += c;
        }
        return result;
    }
    /// For messages: whatever a hostile name holds, one line of ASCII.
    static std::string printable(std::string name)
    {
        std::ranges::replace_if(
            name, [](char c) { return c < ' ' || c > '~'; }, '?');
        return name;
    }

    const std::filesystem::path& path_;
    std::ifstream stream_;
};

/// OpenImageIO's reader on a file whose size is known to be right.
class Decoder {
public:
    Decoder(const std::filesystem::path& path, ImageSize size)
        : path_{path},
          size_{size},
          input_{OIIO::ImageInput::create("openexr")}
    {
        if (input_ == nullptr) {
            throw scene::EnvironmentError(
                fmt::format("OpenImageIO cannot read EXR: {}; install OpenImageIO with its plugins",
                            OIIO::geterror()));
        }
        if (!input_->open(path.string(), spec_)) {
            refuse_aov(path_, "the header is damaged");
        }
        if (spec_.width != size.width_px || spec_.height != size.height_px || spec_.depth != 1 ||
            spec_.x != 0 || spec_.y != 0 || spec_.deep || spec_.tile_width != 0 ||
            spec_.nchannels > most_channels) {
            refuse_aov(path_, "the image is not laid out as an AOV");
        }
    }

    template <typename Value>
    [[nodiscard]] scene::Image<Value> channel(const char* name)
    {
        constexpr auto type =
            std::is_same_v<Value, float> ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT32;
        const int index = spec_.channelindex(name);
        if (index < 0 || spec_.channelformat(index) != type) {
            refuse_aov(path_, fmt::format("channel {} is missing or of another type", name));
        }
        scene::Image<Value> image{size_};
        if (!input_->read_scanlines(0, 0, 0, size_.height_px, 0, index, index + 1, type,
                                    image.data())) {
            refuse_aov(path_, "the pixels are damaged or truncated");
        }
        return image;
    }

    [[nodiscard]] std::map<std::string, std::string> texts() const
    {
        constexpr std::string_view prefix = "gnomon:";
        std::map<std::string, std::string> result;
        for (const OIIO::ParamValue& attribute : spec_.extra_attribs) {
            const std::string_view name{attribute.name().data(), attribute.name().size()};
            if (name.starts_with(prefix) && attribute.type() == OIIO::TypeDesc::STRING) {
                result.emplace(name.substr(prefix.size()), attribute.get_string());
            }
        }
        return result;
    }

private:
    const std::filesystem::path& path_;
    ImageSize size_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
};

scene::Image<scene::PixelClass> pixel_classes(const std::filesystem::path& path,
                                              const scene::Image<std::uint32_t>& codes)
{
    scene::Image<scene::PixelClass> result{codes.size()};
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        if (codes[i] >= scene::pixel_class_count) {
            refuse_aov(path, fmt::format("class code {} is none of 0 to {}", codes[i],
                                         scene::pixel_class_count - 1));
        }
        result[i] = static_cast<scene::PixelClass>(codes[i]);
    }
    return result;
}

} // namespace

Aov read_aov(const std::filesystem::path& path, ImageSize image)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        refuse_aov(path, "no such file");
    }
    const ImageSize size = HeaderScan{path}.size();
    if (size != image) {
        throw scene::InputError(fmt::format(
            "{}: the image is {}x{} pixels but the job's is {}x{}: give the job that it was made "
            "from",
            path.string(), size.width_px, size.height_px, image.width_px, image.height_px));
    }
    Decoder decoder{path, size};
    Aov aov;
    aov.texts = decoder.texts();
    aov.pixel_class = pixel_classes(path, decoder.channel<std::uint32_t>("class"));
    aov.truth = decoder.channel<float>("truth");
    aov.prim = decoder.channel<std::uint32_t>("prim");
    aov.witness = decoder.channel<std::uint32_t>("witness");
    return aov;
}

} // namespace gnomon::reports
