#include "store/images/layer_file.hpp"

#include "scene/error.hpp"

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

namespace gnomon::store {

namespace {

using scene::ImageSize;

/// Limits of an AOV's header, whose longest text is the job with some kilobytes.
constexpr std::size_t longest_name = 255;
constexpr std::size_t largest_attribute_bytes = 1U << 20;
constexpr int most_attributes = 4096; // 64 lights have some 25 each
constexpr std::size_t most_channels = 2048;

[[noreturn]] void refuse_layers(const std::filesystem::path& path, std::string_view what,
                                const std::string& advice)
{
    throw scene::InputError(fmt::format("{}: {}: {}", path.string(), what, advice));
}

/// Reads the image's size from an EXR header, before the decoder allocates memory for it.
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

    /// @throws scene::InputError  if this is not an EXR file of scanlines with a data window.
    [[nodiscard]] ImageSize size()
    {
        constexpr std::uint32_t magic = 20000630;
        constexpr std::uint32_t version = 2;
        constexpr std::uint32_t long_names = 0x400; // the only flag that scanline files may have
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

    /// @param flags  of the version field, without those that scanline files may have.
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
        constexpr std::int32_t largest = 1 << 20; // beyond any image, and excludes overflow below
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
    /// Makes a hostile name one line of ASCII, for messages.
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

const ExrHeader& LayerFile::header()
{
    if (input_) {
        return input_->header();
    }
    if (size_.pixel_count() > most_image_pixels) {
        refuse("it has too many pixels");
    }
    auto input = open_exr(path_);
    if (input == nullptr) {
        refuse("the header is damaged");
    }
    const ExrHeader& header = input->header();
    if (header.size != size_ || header.is_subsampled || header.channels.size() > most_channels) {
        refuse("the image is not laid out as an AOV");
    }
    input_ = std::move(input);
    return header;
}

const ExrHeader::Channel* LayerFile::find(const std::string& name)
{
    const auto& channels = header().channels;
    const auto found = std::ranges::find(channels, name, &ExrHeader::Channel::name);
    return found == channels.end() ? nullptr : &*found;
}

LayerType LayerFile::type(const std::string& name)
{
    const ExrHeader::Channel* const channel = find(name);
    return channel == nullptr ? LayerType::missing : channel->type;
}

std::vector<std::string> LayerFile::names()
{
    std::vector<std::string> names;
    for (const ExrHeader::Channel& channel : header().channels) {
        names.push_back(channel.name);
    }
    return names;
}

std::uint64_t LayerFile::decoded_bytes()
{
    return header().decoded_bytes();
}

template <typename Value>
scene::Image<Value> LayerFile::channel(const std::string& name, LayerType type)
{
    const ExrHeader::Channel* const channel = find(name);
    if (channel == nullptr || channel->type != type) {
        refuse(fmt::format("channel {} is missing or of another type", name));
    }
    if (pixels_.empty()) {
        auto decoded = input_->decoded();
        if (!decoded) {
            refuse("the pixels are damaged or truncated");
        }
        pixels_ = std::move(*decoded);
    }
    const std::size_t stride = header().pixel_bytes;
    const std::byte* next = pixels_.data() + channel->offset_bytes;
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
    if (kept == LayerType::uint32) {
        scene::Image<float> image{size_};
        const scene::Image<std::uint32_t> from = integers(name);
        std::ranges::transform(from, image.data(),
                               [](std::uint32_t value) { return static_cast<float>(value); });
        return image;
    }
    return floats_of(channel<std::uint16_t>(name, LayerType::float16));
}

std::string LayerFile::compression()
{
    return header().compression;
}

bool LayerFile::is_whole_display()
{
    return header().is_whole_display;
}

std::map<std::string, std::string> LayerFile::texts()
{
    constexpr std::string_view prefix = "gnomon:";
    std::map<std::string, std::string> result;
    for (const auto& [name, text] : header().texts) {
        if (name.starts_with(prefix)) {
            result.emplace(name.substr(prefix.size()), text);
        }
    }
    return result;
}

scene::Image<scene::PixelClass> LayerFile::classes(const std::string& name)
{
    const scene::Image<std::uint32_t> codes = integers(name);
    scene::Image<scene::PixelClass> result{codes.size()};
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        if (codes[i] >= scene::pixel_class_count) {
            refuse(fmt::format("class code {} is not in 0 to {}", codes[i],
                               scene::pixel_class_count - 1));
        }
        result[i] = static_cast<scene::PixelClass>(codes[i]);
    }
    return result;
}

} // namespace gnomon::store
