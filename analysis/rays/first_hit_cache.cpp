#include "analysis/rays/first_hit_cache.hpp"

#include <algorithm>
#include <utility>

namespace gnomon::analysis {

using renderers::TexelHit;
using scene::Texel;

namespace {

/// Whether both lists of several maps share a map, as cascades do when only some of them change.
bool shares_a_map(std::span<const scene::LightFrustum> a, std::span<const scene::LightFrustum> b)
{
    if (a.size() != b.size() || a.size() < 2) {
        return false;
    }
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i].light_clip_from_world == b[i].light_clip_from_world) {
            return true;
        }
    }
    return false;
}

} // namespace

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

std::vector<std::uint32_t> FirstHitCache::known_triangles(const Seen& seen,
                                                          std::span<const Texel> texels)
{
    std::vector<std::pair<Packed, std::uint32_t>> by_texel(seen.texels.size());
    for (std::size_t i = 0; i < by_texel.size(); ++i) {
        by_texel[i] = {seen.texels[i], seen.triangles[i]};
    }
    std::ranges::sort(by_texel);
    std::vector<std::uint32_t> triangles(texels.size(), scene::no_triangle);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const Packed asked = packed(texels[i]);
        const auto found =
            std::ranges::lower_bound(by_texel, asked, {}, &std::pair<Packed, std::uint32_t>::first);
        if (found != by_texel.end() && found->first == asked) {
            triangles[i] = found->second;
        }
    }
    return triangles;
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
        return maps.light.first_hits(texels, renderers::KnownHits{seen->frusta, seen->triangles});
    }
    std::vector<TexelHit> hits;
    if (seen != nullptr && shares_a_map(seen->frusta, maps.frusta)) {
        const auto triangles = known_triangles(*seen, texels);
        hits = maps.light.first_hits(texels, renderers::KnownHits{seen->frusta, triangles});
    } else {
        hits = maps.light.first_hits(texels, renderers::HitDetail::placed);
    }
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
