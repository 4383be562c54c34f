#pragma once

#include "reference_rt/traversal/packet.hpp"
#include "scene/widest_vectors.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>

/// Numbers for all lanes of a packet, component by component, for loops over the lanes that the
/// compiler turns into vector instructions.
namespace gnomon::reference_rt {

template <typename Number>
struct alignas(64) Lanes : PacketOf<Number> {
};

struct Lanes3 {
    Lanes<double> x, y, z;
};

/// Index of the lowest lane in the set. Precondition: there is one.
[[nodiscard]] inline std::size_t first_lane(LaneBits lanes)
{
    return static_cast<std::size_t>(std::countr_zero(lanes));
}

/// The lanes that hold `value`.
[[nodiscard]] inline LaneBits lanes_with(const Lanes<std::uint32_t>& numbers, std::uint32_t value)
{
    LaneBits lanes = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        lanes |= numbers[i] == value ? LaneBits{1} << i : 0;
    }
    return lanes;
}

/// The lanes whose flag is not 0.
[[gnu::always_inline]] inline LaneBits bits_of(const Lanes<int>& flags)
{
    LaneBits bits = 0;
    for (std::size_t i = 0; i < packet_size; ++i) {
        bits |= flags[i] != 0 ? LaneBits{1} << i : 0;
    }
    return bits;
}

} // namespace gnomon::reference_rt
