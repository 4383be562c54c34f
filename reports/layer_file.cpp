#include "reports/layer_file.hpp"

#include "scene/error.hpp"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using scene::ImageSize;

/// Beyond these a header is no AOV's: the longest text is the job, some kilobytes.
constexpr std::size_t longest_name = 255;
constexpr std::size_t largest_attribute_bytes = 1U << 20;
constexpr int most_attributes = 256;
constexpr int most_channels = 64;

[[noreturn]] void refuse_layers(const std::filesystem::path& path, std::string_view what,
                                const std::string& advice)
{
    throw scene::InputError(fmt::format("{}: {}: {}", path.string(), what, advice));
}

/// Reads just enough of an EXR header to know the image's size before the decoder, which takes
/// memory for it, sees the file.
class HeaderScan {
public:
    HeaderScan(const std::filesystem::path& path, const std::string& advice)
        : path_{path},
          advice_{advice},
          stream_{path, std::ios::binary}
    {
        if (!stream_) {
            refuse("the file cannot be opened");
        }
    }

    /// @throws scene::InputError  if this is no EXR file of scanlines with a data window.
    [[nodiscard]] ImageSize size()
    {
        constexpr std::uint32_t magic = 20000630;
        constexpr std::uint32_t version = 2;
        constexpr std::uint32_t long_names = 0x400; // the only flag that plain scanlines may have
        if (word() != magic) {
            refuse("not an EXR file");
        }
        refuse_layout(word() & ~long_names, version);
        std::optional<ImageSize> size;
        for (int i = 0; i < most_attributes; ++i) {
            const std::string name = text();
            if (name.empty()) {
                return size ? *size : throw_no_window();
            }
            const std::string type = text();
            const std::uint32_t bytes = word();
            if (bytes > largest_attribute_bytes) {
                refuse(fmt::format("attribute {} is too large", printable(name)));
            }
            if (name == "dataWindow" && type == "box2i" && bytes == sizeof(Window)) {
                size = window_size();
            } else {
                stream_.ignore(static_cast<std::streamsize>(bytes));
            }
        }
        refuse("the header has too many attributes");
    }

private:
    using Window = std::array<std::int32_t, 4>; // left, top, right, bottom; inclusive

    /// @param flags  the version's, but for those that plain scanlines may have.
    void refuse_layout(std::uint32_t flags, std::uint32_t version)
    {
        constexpr std::uint32_t tiled = 0x200;
        constexpr std::uint32_t deep = 0x800;
        constexpr std::uint32_t multi_part = 0x1000;
        if ((flags & multi_part) != 0) {
            refuse("an EXR file of several parts; it must have one");
        }
        if ((flags & (tiled | deep)) != 0) {
            refuse("an EXR file of tiles or deep pixels; it must have plain scanlines");
        }
        if (flags != version) {
            refuse("an EXR file of an unknown version");
        }
    }

    [[noreturn]] ImageSize throw_no_window() { refuse("the header has no data window"); }

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
            refuse("the data window is not an image's: it must begin at (0, 0)");
        }
        return {right + 1, bottom + 1};
    }

    char byte()
    {
        const int value = stream_.get();
        if (value == std::char_traits<char>::eof()) {
            refuse("the header ends too early");
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
                refuse("a name in the header is too long");
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

    [[noreturn]] void refuse(std::string_view what) const { refuse_layers(path_, what, advice_); }

    const std::filesystem::path& path_;
    const std::string& advice_;
    std::ifstream stream_;
};

ImageSize scanned_size(const std::filesystem::path& path, const std::string& advice)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        refuse_layers(path, "no such file", advice);
    }
    return HeaderScan{path, advice}.size();
}

} // namespace

/// OpenImageIO's reader, once the file's size is known to be right.
struct LayerFile::Reader {
    std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create("openexr");
    OIIO::ImageSpec spec;
    /// All channels as the file has them: they are compressed together, so that reading one by one
    /// would decompress each of them every time.
    std::vector<std::byte> pixels;
};

LayerFile::LayerFile(const std::filesystem::path& path, std::string advice)
    : path_{path},
      advice_{std::move(advice)},
      size_{scanned_size(path, advice_)}
{
}

void LayerFile::refuse(std::string_view what) const
{
    refuse_layers(path_, what, advice_);
}

LayerFile::LayerFile(LayerFile&&) noexcept = default;
LayerFile& LayerFile::operator=(LayerFile&&) noexcept = default;
LayerFile::~LayerFile() = default;

LayerFile::Reader& LayerFile::reader()
{
    if (reader_) {
        return *reader_;
    }
    auto reader = std::make_unique<Reader>();
    if (reader->input == nullptr) {
        throw scene::EnvironmentError(
            fmt::format("OpenImageIO cannot read EXR: {}; install OpenImageIO with its plugins",
                        OIIO::geterror()));
    }
    if (!reader->input->open(path_.string(), reader->spec)) {
        refuse("the header is damaged");
    }
    const OIIO::ImageSpec& spec = reader->spec;
    if (spec.width != size_.width_px || spec.height != size_.height_px || spec.depth != 1 ||
        spec.x != 0 || spec.y != 0 || spec.deep || spec.tile_width != 0 ||
        spec.nchannels > most_channels) {
        refuse("the image is not laid out as an AOV");
    }
    reader_ = std::move(reader);
    return *reader_;
}

bool LayerFile::has(const std::string& name)
{
    return reader().spec.channelindex(name) >= 0;
}

LayerType LayerFile::type(const std::string& name)
{
    const OIIO::ImageSpec& spec = reader().spec;
    const int index = spec.channelindex(name);
    if (index < 0) {
        return LayerType::missing;
    }
    const OIIO::TypeDesc type = spec.channelformat(index);
    return type == OIIO::TypeDesc::FLOAT    ? LayerType::float32
           : type == OIIO::TypeDesc::HALF   ? LayerType::float16
           : type == OIIO::TypeDesc::UINT32 ? LayerType::uint32
                                            : LayerType::other;
}

std::vector<std::string> LayerFile::names()
{
    const auto& names = reader().spec.channelnames;
    return {names.begin(), names.end()};
}

std::uint64_t LayerFile::decoded_bytes()
{
    return reader().spec.image_bytes(true);
}

template <typename Value>
scene::Image<Value> LayerFile::channel(const std::string& name, LayerType type)
{
    if (this->type(name) != type) {
        refuse(fmt::format("channel {} is missing or of another type", name));
    }
    Reader& from = reader();
    if (from.pixels.empty()) {
        from.pixels.resize(from.spec.image_bytes(true));
        if (!from.input->read_scanlines(0, 0, 0, size_.height_px, 0, 0, from.spec.nchannels,
                                        OIIO::TypeDesc::UNKNOWN, from.pixels.data())) {
            from.pixels.clear();
            refuse("the pixels are damaged or truncated");
        }
    }
    const std::size_t stride = from.spec.pixel_bytes(true);
    const std::byte* next =
        from.pixels.data() + from.spec.pixel_bytes(0, from.spec.channelindex(name), true);
    scene::Image<Value> image{size_};
    for (std::size_t i = 0; i < image.pixel_count(); ++i, next += stride) {
        std::memcpy(&image[i], next, sizeof(Value));
    }
    return image;
}

scene::Image<float> LayerFile::floats(const std::string& name)
{
    return channel<float>(name, LayerType::float32);
}

scene::Image<std::uint32_t> LayerFile::integers(const std::string& name)
{
    return channel<std::uint32_t>(name, LayerType::uint32);
}

scene::Image<float> LayerFile::numbers(const std::string& name)
{
    const LayerType kept = type(name);
    if (kept == LayerType::float32) {
        return floats(name);
    }
    scene::Image<float> image{size_};
    if (kept == LayerType::uint32) {
        const scene::Image<std::uint32_t> from = integers(name);
        std::ranges::transform(from, image.data(),
                               [](std::uint32_t value) { return static_cast<float>(value); });
        return image;
    }
    const auto from = channel<std::uint16_t>(name, LayerType::float16);
    OIIO::convert_pixel_values(OIIO::TypeDesc::HALF, from.data(), OIIO::TypeDesc::FLOAT,
                               image.data(), static_cast<int>(image.pixel_count()));
    return image;
}

std::string LayerFile::compression()
{
    const std::string name{reader().spec.get_string_attribute("compression")};
    return name.substr(0, name.find(':')); // "dwaa:45": with its level
}

bool LayerFile::is_whole_display()
{
    const OIIO::ImageSpec& spec = reader().spec;
    return spec.full_x == 0 && spec.full_y == 0 && spec.full_width == size_.width_px &&
           spec.full_height == size_.height_px;
}

std::map<std::string, std::string> LayerFile::texts()
{
    constexpr std::string_view prefix = "gnomon:";
    std::map<std::string, std::string> result;
    for (const OIIO::ParamValue& attribute : reader().spec.extra_attribs) {
        const std::string_view name{attribute.name().data(), attribute.name().size()};
        if (name.starts_with(prefix) && attribute.type() == OIIO::TypeDesc::STRING) {
            result.emplace(name.substr(prefix.size()), attribute.get_string());
        }
    }
    return result;
}

scene::Image<scene::PixelClass> LayerFile::classes()
{
    const scene::Image<std::uint32_t> codes = integers("class");
    scene::Image<scene::PixelClass> result{codes.size()};
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        if (codes[i] >= scene::pixel_class_count) {
            refuse(fmt::format("class code {} is none of 0 to {}", codes[i],
                               scene::pixel_class_count - 1));
        }
        result[i] = static_cast<scene::PixelClass>(codes[i]);
    }
    return result;
}

} // namespace gnomon::reports
