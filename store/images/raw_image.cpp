#include "store/images/raw_image.hpp"

#include "scene/error.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace gnomon::store {

static_assert(std::endian::native == std::endian::little,
              "raw floats are read without swapping bytes");

namespace {

constexpr std::size_t longest_header_bytes = 65536; // numpy writes 128, PFM 30
constexpr int largest_side_px = 1 << 20;            // as for EXR files

/// A fault in a header, without the file's name and the advice.
struct HeaderFault {
    std::string what;
};

[[noreturn]] void refuse_raw(std::string what)
{
    throw HeaderFault{std::move(what)};
}

/// Parses the header's text from its front.
class HeaderParser {
public:
    explicit HeaderParser(std::string_view text) : rest_{text} {}

    [[nodiscard]] std::string_view rest() const { return rest_; }
    bool skip(std::string_view word)
    {
        const bool is_there = rest_.starts_with(word);
        rest_.remove_prefix(is_there ? word.size() : 0);
        return is_there;
    }
    void skip_spaces()
    {
        while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
            rest_.remove_prefix(1);
        }
    }
    template <typename Number>
    std::optional<Number> number()
    {
        Number value{};
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{}) {
            return std::nullopt;
        }
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }

private:
    std::string_view rest_;
};

int checked_side(std::optional<int> side)
{
    if (!side || *side < 1 || *side > largest_side_px) {
        refuse_raw(fmt::format("the header's sizes are not from 1 to {} pixels", largest_side_px));
    }
    return *side;
}

/// The text after "'KEY':" in the dictionary of a .npy file's header.
HeaderParser npy_value(std::string_view header, std::string_view key)
{
    const std::string word = fmt::format("'{}':", key);
    const std::size_t at = header.find(word);
    if (at == std::string_view::npos) {
        refuse_raw(fmt::format("the header has no {}", key));
    }
    HeaderParser value{header.substr(at + word.size())};
    value.skip_spaces();
    return value;
}

/// The two or three numbers of a .npy file's shape.
std::vector<int> npy_shape(std::string_view header)
{
    HeaderParser shape = npy_value(header, "shape");
    std::vector<int> sides;
    if (!shape.skip("(")) {
        refuse_raw("the header's shape is not a tuple");
    }
    while (!shape.skip(")") && sides.size() < 4) {
        sides.push_back(checked_side(shape.number<int>()));
        shape.skip(",");
        shape.skip_spaces();
    }
    if (sides.size() != 2 && sides.size() != 3) {
        refuse_raw("the array's shape must be (height, width) or (height, width, channels)");
    }
    return sides;
}

RawLayout npy_layout(std::string_view head)
{
    constexpr std::size_t version_at = 6;
    constexpr std::size_t short_length_at = 8;
    if (head.size() < 12) {
        refuse_raw("the header ends too early");
    }
    const auto byte = [&](std::size_t at) {
        return std::size_t{static_cast<unsigned char>(head[at])};
    };
    const std::size_t version = byte(version_at);
    if (version < 1 || version > 3) {
        refuse_raw(fmt::format("a .npy file of unknown version {}", version));
    }
    const bool is_short = version == 1;
    std::size_t length = byte(short_length_at) | byte(short_length_at + 1) << 8U;
    length |= is_short ? 0 : byte(short_length_at + 2) << 16U | byte(short_length_at + 3) << 24U;
    const std::size_t begin = short_length_at + (is_short ? 2 : 4);
    if (length > head.size() - begin) {
        refuse_raw("the header ends too early");
    }
    const std::string_view header = head.substr(begin, length);
    HeaderParser type = npy_value(header, "descr");
    if (!type.skip("'<f4'")) {
        refuse_raw("the numbers are not 32-bit little-endian floats; save array.astype('<f4')");
    }
    HeaderParser order = npy_value(header, "fortran_order");
    if (!order.skip("False")) {
        refuse_raw("columns come before rows (fortran_order); save numpy.ascontiguousarray(array)");
    }
    const std::vector<int> shape = npy_shape(header);
    return {{shape[1], shape[0]}, shape.size() == 3 ? shape[2] : 1, begin + length, false};
}

RawLayout pfm_layout(std::string_view head)
{
    HeaderParser text{head};
    const bool has_colour = text.skip("PF");
    if (!has_colour && !text.skip("Pf")) {
        refuse_raw("neither a .npy nor a .pfm file");
    }
    text.skip_spaces();
    const int width = checked_side(text.number<int>());
    text.skip_spaces();
    const int height = checked_side(text.number<int>());
    text.skip_spaces();
    const auto scale = text.number<double>();
    if (scale != -1.0) {
        refuse_raw("the header's scale is not -1: little-endian, in the numbers' own unit");
    }
    text.skip("\r");
    if (!text.skip("\n") && !text.skip(" ")) {
        refuse_raw("the header ends too early");
    }
    const std::size_t begin = head.size() - text.rest().size();
    return {{width, height}, has_colour ? 3 : 1, begin, true};
}

std::uint64_t raw_bytes(const RawLayout& layout)
{
    return layout.size.pixel_count() * static_cast<std::uint64_t>(layout.channel_count) *
           sizeof(float);
}

RawLayout raw_layout(const std::filesystem::path& path)
{
    constexpr std::string_view npy_magic = "\x93NUMPY";
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        refuse_raw("no such file");
    }
    std::ifstream stream{path, std::ios::binary};
    if (!stream) {
        refuse_raw("the file cannot be opened");
    }
    std::string head(longest_header_bytes, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    const RawLayout layout = head.starts_with(npy_magic) ? npy_layout(head) : pfm_layout(head);
    const std::uint64_t needed = layout.offset_bytes + raw_bytes(layout);
    const std::uint64_t bytes = std::filesystem::file_size(path, error);
    if (error || bytes != needed) {
        refuse_raw(fmt::format("{} bytes, but {}x{} pixels of {} floats and the header are {}",
                               bytes, layout.size.width_px, layout.size.height_px,
                               layout.channel_count, needed));
    }
    return layout;
}

} // namespace

RawImage::RawImage(const std::filesystem::path& path, std::vector<std::string> names,
                   std::size_t least, std::string advice)
    : path_{path},
      names_{std::move(names)},
      advice_{std::move(advice)}
{
    try {
        layout_ = raw_layout(path);
    } catch (const HeaderFault& refusal) {
        refuse(refusal.what);
    }
    const auto count = static_cast<std::size_t>(layout_.channel_count);
    if (count < least || count > names_.size()) {
        const std::string wanted = least == names_.size()
                                       ? fmt::format("{}", least)
                                       : fmt::format("{} or {}", least, names_.size());
        refuse(fmt::format("{}x{} pixels with {} numbers each; it must have {}",
                           layout_.size.width_px, layout_.size.height_px, count, wanted));
    }
    names_.resize(count);
}

LayerType RawImage::type(const std::string& name)
{
    return std::ranges::find(names_, name) == names_.end() ? LayerType::missing
                                                           : LayerType::float32;
}

std::uint64_t RawImage::decoded_bytes()
{
    return raw_bytes(layout_);
}

scene::Image<float> RawImage::floats(const std::string& name)
{
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) {
        refuse(fmt::format("channel {} is missing", name));
    }
    const auto count = static_cast<std::size_t>(layout_.channel_count);
    if (pixels_.empty()) {
        std::ifstream stream{path_, std::ios::binary};
        std::vector<float> pixels(layout_.size.pixel_count() * count);
        stream.seekg(static_cast<std::streamoff>(layout_.offset_bytes));
        stream.read(reinterpret_cast<char*>(pixels.data()),
                    static_cast<std::streamsize>(decoded_bytes()));
        if (!stream) {
            refuse("the pixels cannot be read");
        }
        pixels_ = std::move(pixels);
    }
    const auto channel = static_cast<std::size_t>(found - names_.begin());
    const auto [width, height] = layout_.size;
    scene::Image<float> image{layout_.size};
    std::size_t next = channel;
    for (int row = 0; row < height; ++row) {
        const int y = layout_.is_bottom_up ? height - 1 - row : row;
        for (int x = 0; x < width; ++x, next += count) {
            image(x, y) = pixels_[next];
        }
    }
    return image;
}

scene::Image<std::uint32_t> RawImage::integers(const std::string& name)
{
    refuse(fmt::format("channel {} has floats", name));
}

void RawImage::refuse(const std::string& what) const
{
    throw scene::InputError(
        fmt::format("{}: {}: {}", scene::one_line(path_.string()), what, advice_));
}

bool is_raw_image(const std::filesystem::path& path)
{
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return ending == ".npy" || ending == ".pfm";
}

} // namespace gnomon::store
