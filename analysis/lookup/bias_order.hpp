#pragma once

#include <bit>
#include <cstdint>

namespace gnomon::analysis {

/// Rank of the largest bias, which is the largest finite float32; infinity comes next.
inline constexpr std::int32_t largest_bias_rank = 0x7F000000;

/// Numbers all valid biases in ascending order without gaps. Valid are 0 and the normal float32 of
/// either sign: 0 has rank 0, the smallest normal float32 has rank 1.
/// @param bias  A valid bias, or ±∞, which has rank ±(`largest_bias_rank` + 1).
[[nodiscard]] constexpr std::int32_t bias_rank(float bias)
{
    const auto bits = std::bit_cast<std::uint32_t>(bias);
    const std::uint32_t magnitude = bits & 0x7FFFFFFF;
    constexpr std::uint32_t largest_subnormal = 0x007FFFFF;
    const auto rank = magnitude == 0 ? 0 : static_cast<std::int32_t>(magnitude - largest_subnormal);
    return (bits >> 31) != 0 ? -rank : rank;
}

/// The inverse of `bias_rank`, for ranks in ±(`largest_bias_rank` + 1).
[[nodiscard]] constexpr float bias_of_rank(std::int32_t rank)
{
    if (rank == 0) {
        return 0.0F;
    }
    const std::uint32_t sign = rank < 0 ? 0x80000000 : 0;
    const auto magnitude = static_cast<std::uint32_t>(rank < 0 ? -rank : rank) + 0x007FFFFF;
    return std::bit_cast<float>(sign | magnitude);
}

/// The largest bias below `bias`; −∞ for −∞.
[[nodiscard]] constexpr float previous_bias(float bias)
{
    const std::int32_t rank = bias_rank(bias);
    return bias_of_rank(rank < -largest_bias_rank ? rank : rank - 1);
}

/// The smallest bias above `bias`; +∞ for +∞.
[[nodiscard]] constexpr float next_bias(float bias)
{
    const std::int32_t rank = bias_rank(bias);
    return bias_of_rank(rank > largest_bias_rank ? rank : rank + 1);
}

} // namespace gnomon::analysis
