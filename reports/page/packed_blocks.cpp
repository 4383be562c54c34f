#include "reports/page/packed_blocks.hpp"

#include "store/json_values.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <string_view>
#include <unordered_map>

namespace gnomon::reports {

std::string base64(std::span<const std::byte> bytes)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8U | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= count ? digits[group >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

namespace {

constexpr int most_differences = 2;
constexpr std::uint32_t no_text = std::numeric_limits<std::uint32_t>::max();

template <typename Bits>
void take_differences(std::vector<Bits>& bits)
{
    for (std::size_t i = bits.size(); i-- > 1;) {
        bits[i] = static_cast<Bits>(bits[i] - bits[i - 1]);
    }
}

template <typename Bits>
std::vector<std::byte> byte_planes(std::span<const Bits> bits)
{
    std::vector<std::byte> planes;
    planes.reserve(bits.size_bytes());
    for (std::size_t byte = 0; byte < sizeof(Bits); ++byte) {
        for (const Bits number : bits) {
            planes.push_back(static_cast<std::byte>((number >> (8 * byte)) & 0xFFU));
        }
    }
    return planes;
}

std::vector<std::byte> deflated(std::span<const std::byte> bytes, int level)
{
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<std::byte> result(size);
    // The buffer is large enough, so compress2() fails only without memory.
    if (compress2(reinterpret_cast<Bytef*>(result.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                  level) != Z_OK) {
        throw std::bad_alloc{};
    }
    result.resize(size);
    return result;
}

/// The best number of differences, estimated from the middle of the array.
template <typename Bits>
int best_differences(const std::vector<Bits>& bits)
{
    constexpr std::size_t sample_size = 1U << 16U;
    const std::size_t count = std::min(bits.size(), sample_size);
    const auto first = bits.begin() + static_cast<std::ptrdiff_t>((bits.size() - count) / 2);
    std::vector<Bits> sample(first, first + static_cast<std::ptrdiff_t>(count));
    int best = 0;
    std::size_t best_size = std::numeric_limits<std::size_t>::max();
    for (int differences = 0; differences <= most_differences; ++differences) {
        const std::size_t size =
            deflated(byte_planes(std::span<const Bits>{sample}), Z_BEST_SPEED).size();
        if (size < best_size) {
            best = differences;
            best_size = size;
        }
        take_differences(sample);
    }
    return best;
}

template <typename Bits, typename Value>
std::vector<Bits> bits_of(std::span<const Value> values)
{
    std::vector<Bits> bits;
    bits.reserve(values.size());
    for (const Value value : values) {
        bits.push_back(std::bit_cast<Bits>(value));
    }
    return bits;
}

template <typename Bits>
PackedArray pack_bits(const std::vector<Bits>& bits, std::string_view type, int differences)
{
    const auto planes = byte_planes(std::span<const Bits>{bits});
    return {base64(deflated(planes, Z_DEFAULT_COMPRESSION)), type, bits.size(), differences};
}

template <typename Bits>
PackedArray pack_differences(std::vector<Bits> bits, std::string_view type)
{
    const int differences = best_differences(bits);
    for (int i = 0; i < differences; ++i) {
        take_differences(bits);
    }
    return pack_bits(bits, type, differences);
}

} // namespace

PackedArray pack(std::span<const float> values)
{
    return pack_differences(bits_of<std::uint32_t>(values), "f32");
}

PackedArray pack(std::span<const double> values)
{
    return pack_bits(bits_of<std::uint64_t>(values), "f64", 0);
}

PackedArray pack(std::span<const std::uint8_t> values)
{
    return pack_differences(bits_of<std::uint8_t>(values), "u8");
}

PackedArray pack(std::span<const std::uint16_t> values)
{
    return pack_differences(bits_of<std::uint16_t>(values), "u16");
}

PackedArray pack(std::span<const std::uint32_t> values)
{
    return pack_differences(bits_of<std::uint32_t>(values), "u32");
}

store::Json PackedBlocks::add(PackedArray array)
{
    auto place = std::find(texts_.begin(), texts_.end(), array.text);
    if (place == texts_.end()) {
        place = texts_.insert(texts_.end(), std::move(array.text));
    }
    return {{"block", fmt::format("b{}", place - texts_.begin())},
            {"type", array.type},
            {"count", array.count},
            {"delta", array.differences}};
}

std::size_t PackedBlocks::byte_count() const
{
    return std::transform_reduce(texts_.begin(), texts_.end(), std::size_t{0}, std::plus{},
                                 [](const std::string& text) { return text.size(); });
}

store::Json PackedBlocks::add_texts(std::span<const std::string> texts)
{
    std::unordered_map<std::string_view, std::uint32_t> index_of;
    store::Json dictionary = store::Json::array();
    std::vector<std::uint32_t> indices;
    indices.reserve(texts.size());
    for (const std::string& text : texts) {
        if (text.empty()) {
            indices.push_back(no_text);
            continue;
        }
        const auto [entry, is_new] =
            index_of.try_emplace(text, static_cast<std::uint32_t>(index_of.size()));
        if (is_new) {
            dictionary.push_back(text);
        }
        indices.push_back(entry->second);
    }
    store::Json json = add(pack(std::span<const std::uint32_t>{indices}));
    json["type"] = "text";
    json["dictionary"] = std::move(dictionary);
    return json;
}

} // namespace gnomon::reports
