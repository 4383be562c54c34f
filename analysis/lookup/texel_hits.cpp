#include "analysis/lookup/texel_hits.hpp"

namespace gnomon::analysis {

using scene::Texel;

TexelHits::TexelHits(const renderers::LightQueries& light, std::span<const Texel> texels,
                     renderers::HitDetail detail)
    : index_{texels},
      hits_{light.first_hits(index_.texels(), detail)}
{
}

TexelHits::TexelHits(std::span<const Texel> texels, const FindFirstHits& find)
    : index_{texels},
      hits_{find(index_.texels())}
{
}

std::vector<Texel> texels_of(std::span<const Tap> taps)
{
    std::vector<Texel> texels;
    texels.reserve(taps.size());
    for (const Tap& tap : taps) {
        if (tap.is_inside) {
            texels.push_back(tap.texel);
        }
    }
    return texels;
}

} // namespace gnomon::analysis
