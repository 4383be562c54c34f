#pragma once

#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/texel_index.hpp"
#include "renderers/light_queries.hpp"

#include <functional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Finds the first hits of texels, in their order.
using FindFirstHits =
    std::function<std::vector<renderers::TexelHit>(std::span<const scene::Texel> texels)>;

/// What the light sees through a set of texels, each traced once.
class TexelHits {
public:
    /// @param texels  of the map, in any order, repetitions included.
    TexelHits(const renderers::LightQueries& light, std::span<const scene::Texel> texels,
              renderers::HitDetail detail);
    /// @param find  gives the first hits of texels.
    TexelHits(std::span<const scene::Texel> texels, const FindFirstHits& find);

    /// The texel's place among the hits. Precondition: it was among those given.
    [[nodiscard]] std::size_t number_of(const scene::Texel& texel) const { return index_[texel]; }
    [[nodiscard]] const renderers::TexelHit& by_number(std::size_t number) const
    {
        return hits_[number];
    }
    [[nodiscard]] const scene::Texel& texel(std::size_t number) const
    {
        return index_.texels()[number];
    }
    /// Null if the texel was not among those given.
    [[nodiscard]] const renderers::TexelHit* find(const scene::Texel& texel) const
    {
        return index_.has(texel) ? &hits_[index_[texel]] : nullptr;
    }
    /// Precondition: the texel was among those given.
    [[nodiscard]] const renderers::TexelHit& operator[](const scene::Texel& texel) const
    {
        return hits_[index_[texel]];
    }

private:
    TexelIndex index_;
    std::vector<renderers::TexelHit> hits_;
};

/// The texels that taps read.
[[nodiscard]] std::vector<scene::Texel> texels_of(std::span<const Tap> taps);

} // namespace gnomon::analysis
