#include "analysis/lookup/texel_hits.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::Texel;

TexelIndex::TexelIndex(std::span<const Texel> texels)
{
    if (!texels.empty()) {
        frame(texels);
        mark(texels);
        number();
    }
}

void TexelIndex::frame(std::span<const Texel> texels)
{
    Texel lowest = texels.front();
    Texel highest = lowest;
    for (const Texel& texel : texels) {
        lowest = {std::min(lowest.x, texel.x), std::min(lowest.y, texel.y)};
        highest = {std::max(highest.x, texel.x), std::max(highest.y, texel.y),
                   std::max(highest.map, texel.map)};
    }
    first_column_ = lowest.x >> side_bits;
    first_row_ = lowest.y >> side_bits;
    columns_ = static_cast<std::size_t>((highest.x >> side_bits) - first_column_) + 1;
    rows_ = static_cast<std::size_t>((highest.y >> side_bits) - first_row_) + 1;
    block_at_.assign(cell_of(highest) + 1, none);
}

void TexelIndex::mark(std::span<const Texel> texels)
{
    for (const Texel& texel : texels) {
        std::uint32_t& block = block_at_[cell_of(texel)];
        if (block == none) {
            block = static_cast<std::uint32_t>(blocks_.size());
            blocks_.emplace_back();
            origins_.push_back({texel.x - texel.x % side, texel.y - texel.y % side, texel.map});
        }
        blocks_[block].places |= std::uint64_t{1} << place_of(texel);
    }
}

void TexelIndex::number()
{
    std::array<Texel, std::size_t{side} * side> step;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            step[place_of({x, y})] = {x, y};
        }
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        blocks_[b].first = static_cast<std::uint32_t>(texels_.size());
        for (std::uint64_t rest = blocks_[b].places; rest != 0; rest &= rest - 1) {
            const Texel& within = step[static_cast<std::size_t>(std::countr_zero(rest))];
            texels_.push_back(
                {origins_[b].x + within.x, origins_[b].y + within.y, origins_[b].map});
        }
    }
}

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
