#include "analysis/answers/first_hit_cache.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::Texel;
using scene::TexelHit;

FirstHitCache::Packed FirstHitCache::packed(const Texel& texel)
{
    return static_cast<Packed>(texel.y) << 16U | static_cast<Packed>(texel.x);
}

bool FirstHitCache::is_of(const Seen& seen, std::span<const Texel> texels)
{
    return std::ranges::equal(seen.texels, texels, {}, {}, packed);
}

FirstHitCache::Seen* FirstHitCache::find(const Map& map)
{
    const auto found = std::ranges::find_if(seen_, [&](const Seen& seen) {
        return seen.resolution_texels == map.resolution_texels && seen.cull == map.cull;
    });
    return found == seen_.end() ? nullptr : &*found;
}

std::vector<TexelHit> FirstHitCache::first_hits(const Map& map, std::span<const Texel> texels)
{
    const Seen* const seen = find(map);
    const bool is_known =
        seen != nullptr && seen->frustum.near_m <= map.frustum.near_m && is_of(*seen, texels);
    if (is_known) {
        return map.light.first_hits(texels, scene::KnownHits{seen->frustum, seen->triangles});
    }
    std::vector<TexelHit> hits = map.light.first_hits(texels, scene::HitDetail::placed);
    remember(map, texels, hits);
    return hits;
}

void FirstHitCache::remember(const Map& map, std::span<const Texel> texels,
                             std::span<const TexelHit> hits)
{
    Seen* seen = find(map);
    const std::size_t own = seen == nullptr ? 0 : seen->texels.size();
    if (texels.size() > room_ + own) {
        return;
    }
    if (seen == nullptr) {
        seen = &seen_.emplace_back(Seen{map.resolution_texels, map.cull, {}, {}, {}});
    }
    room_ = room_ + own - texels.size();
    seen->frustum = map.frustum;
    seen->texels.resize(texels.size());
    std::ranges::transform(texels, seen->texels.begin(), packed);
    seen->triangles.resize(hits.size());
    std::ranges::transform(hits, seen->triangles.begin(), &TexelHit::triangle);
}

} // namespace gnomon::analysis
