#pragma once

#include "analysis/footprint.hpp"
#include "scene/exact_light.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// What the light sees through a set of texels, each traced once.
class TexelHits {
public:
    /// @param texels  of the map, in any order, repetitions included.
    TexelHits(const scene::ExactLight& light, std::span<const scene::Texel> texels);
    /// @param taps  those outside the map are left out.
    TexelHits(const scene::ExactLight& light, std::span<const Tap> taps);

    /// Precondition: the texel was among those given.
    [[nodiscard]] const scene::TexelHit& operator[](const scene::Texel& texel) const;

private:
    void trace(const scene::ExactLight& light);

    std::vector<std::uint64_t> keys_; ///< ascending, by row and column
    std::vector<scene::TexelHit> hits_;
};

} // namespace gnomon::analysis
