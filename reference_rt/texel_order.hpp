#pragma once

#include "scene/exact_light.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt {

/// Texels in Z-order: sixteen in a row are as a rule 4×4 neighbours.
class TexelOrder {
public:
    /// Precondition: coordinates are in [0, 65535], and there are fewer than 2^32 texels.
    explicit TexelOrder(std::span<const scene::Texel> texels) : keys_(texels.size())
    {
        tbb::parallel_for(std::size_t{0}, texels.size(), [&](std::size_t i) {
            keys_[i] = (spread(texels[i].x) | spread(texels[i].y) << 1U) << 32U | i;
        });
        tbb::parallel_sort(keys_);
    }

    /// The index of the texel at a place in the order.
    [[nodiscard]] std::size_t operator[](std::size_t place) const
    {
        return keys_[place] & 0xFFFFFFFFU;
    }

private:
    /// Puts a zero before each of sixteen bits.
    [[nodiscard]] static std::uint64_t spread(int coordinate)
    {
        auto bits = static_cast<std::uint64_t>(coordinate);
        bits = (bits | bits << 8U) & 0x00FF00FFU;
        bits = (bits | bits << 4U) & 0x0F0F0F0FU;
        bits = (bits | bits << 2U) & 0x33333333U;
        return (bits | bits << 1U) & 0x55555555U;
    }

    std::vector<std::uint64_t> keys_; ///< place in the order above, index below
};

} // namespace gnomon::reference_rt
