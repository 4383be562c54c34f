#include "analysis/answers/first_hit_cache.hpp"

#include <algorithm>

namespace gnomon::analysis {

using scene::Texel;
using scene::TexelHit;

FirstHitCache::Packed FirstHitCache::packed(const Texel& texel)
{
    return static_cast<Packed>(texel.map) << 28U | static_cast<Packed>(texel.y) << 14U |
           static_cast<Packed>(texel.x);
}

bool FirstHitCache::is_of(const Seen& seen, std::span<const Texel> texels)
{
    return std::ranges::equal(seen.texels, texels, {}, {}, packed);
}

FirstHitCache::Seen* FirstHitCache::find(const Maps& maps)
{
    const auto found = std::ranges::find_if(seen_, [&](const Seen& seen) {
        return seen.resolution_texels == maps.resolution_texels && seen.cull == maps.cull;
    });
    return found == seen_.end() ? nullptr : &*found;
}

std::vector<TexelHit> FirstHitCache::first_hits(const Maps& maps, std::span<const Texel> texels)
{
    const Seen* const seen = find(maps);
    const auto begins_no_nearer = [](const scene::LightFrustum& known,
                                     const scene::LightFrustum& asked) {
        return known.near_m <= asked.near_m;
    };
    const bool is_known = seen != nullptr &&
                          std::ranges::equal(seen->frusta, maps.frusta, begins_no_nearer) &&
                          is_of(*seen, texels);
    if (is_known) {
        return maps.light.first_hits(texels, scene::KnownHits{seen->frusta, seen->triangles});
    }
    std::vector<TexelHit> hits = maps.light.first_hits(texels, scene::HitDetail::placed);
    remember(maps, texels, hits);
    return hits;
}

void FirstHitCache::remember(const Maps& maps, std::span<const Texel> texels,
                             std::span<const TexelHit> hits)
{
    Seen* seen = find(maps);
    const std::size_t own = seen == nullptr ? 0 : seen->texels.size();
    if (texels.size() > room_ + own) {
        return;
    }
    if (seen == nullptr) {
        seen = &seen_.emplace_back(Seen{maps.resolution_texels, maps.cull, {}, {}, {}});
    }
    room_ = room_ + own - texels.size();
    seen->frusta.assign(maps.frusta.begin(), maps.frusta.end());
    seen->texels.resize(texels.size());
    std::ranges::transform(texels, seen->texels.begin(), packed);
    seen->triangles.resize(hits.size());
    std::ranges::transform(hits, seen->triangles.begin(), &TexelHit::triangle);
}

} // namespace gnomon::analysis
