#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Maps a float32 to an integer that sorts alike: −∞ first, +∞ last; −0 equals 0. NaN is not
/// allowed.
[[nodiscard]] constexpr std::uint32_t sort_key(float value)
{
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);
    return bits ^ ((bits >> 31) != 0 ? 0xFFFFFFFF : 0x80000000);
}

/// The inverse of `sort_key`.
[[nodiscard]] constexpr float value_of_key(std::uint32_t key)
{
    return std::bit_cast<float>(key ^ ((key >> 31) != 0 ? 0x80000000 : 0xFFFFFFFF));
}

/// Sorts items in ascending order of an unsigned 32-bit key; equal keys keep their order.
///
/// Starts at the least significant of three digits of 11 bits. Skips a digit that all keys share.
/// @param items   Fewer than 2^32.
/// @param key_of  std::uint32_t(const Item&), cheap.
template <typename Item, typename KeyOf>
void radix_sort(std::vector<Item>& items, const KeyOf& key_of)
{
    constexpr int digit_bits = 11;
    constexpr std::uint32_t digits = 1U << digit_bits;
    using Histogram = std::array<std::uint32_t, digits>; // three of them fit the L1 cache
    const auto digit_of = [](std::uint32_t key, std::size_t pass) {
        return (key >> (digit_bits * pass)) & (digits - 1);
    };
    std::array<Histogram, 3> counts{};
    for (const Item& item : items) {
        const std::uint32_t key = key_of(item);
        for (std::size_t pass = 0; pass < counts.size(); ++pass) {
            ++counts[pass][digit_of(key, pass)];
        }
    }
    std::vector<Item> sorted(items.size());
    for (std::size_t pass = 0; pass < counts.size(); ++pass) {
        Histogram& next = counts[pass];
        if (items.empty() || next[digit_of(key_of(items.front()), pass)] == items.size()) {
            continue;
        }
        std::uint32_t position = 0;
        for (std::uint32_t& count : next) {
            position += std::exchange(count, position);
        }
        for (const Item& item : items) {
            sorted[next[digit_of(key_of(item), pass)]++] = item;
        }
        items.swap(sorted);
    }
}

/// Sorts float32 values in ascending order. NaN is not allowed.
inline void radix_sort(std::vector<float>& values)
{
    radix_sort(values, [](float value) { return sort_key(value); });
}

} // namespace gnomon::analysis
