#include "analysis/texel_hits.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cassert>
#include <iterator>

namespace gnomon::analysis {

using scene::Texel;

namespace {

std::uint64_t key_of(const Texel& texel)
{
    return static_cast<std::uint64_t>(texel.y) << 32U | static_cast<std::uint32_t>(texel.x);
}

Texel texel_of(std::uint64_t key)
{
    return {static_cast<int>(key & 0xFFFFFFFFU), static_cast<int>(key >> 32U)};
}

/// Neighbouring pixels often share a texel.
void append(std::uint64_t key, std::vector<std::uint64_t>& keys)
{
    if (keys.empty() || keys.back() != key) {
        keys.push_back(key);
    }
}

} // namespace

TexelHits::TexelHits(const scene::ExactLight& light, std::span<const Texel> texels)
{
    keys_.reserve(texels.size());
    for (const Texel& texel : texels) {
        append(key_of(texel), keys_);
    }
    trace(light);
}

TexelHits::TexelHits(const scene::ExactLight& light, std::span<const Tap> taps)
{
    keys_.reserve(taps.size());
    for (const Tap& tap : taps) {
        if (tap.is_inside) {
            append(key_of(tap.texel), keys_);
        }
    }
    trace(light);
}

void TexelHits::trace(const scene::ExactLight& light)
{
    tbb::parallel_sort(keys_);
    keys_.erase(std::ranges::unique(keys_).begin(), keys_.end());
    std::vector<Texel> unique;
    unique.reserve(keys_.size());
    std::ranges::transform(keys_, std::back_inserter(unique), texel_of);
    hits_ = light.first_hits(unique);
}

const scene::TexelHit& TexelHits::operator[](const Texel& texel) const
{
    const auto found = std::ranges::lower_bound(keys_, key_of(texel));
    assert(found != keys_.end() && *found == key_of(texel));
    return hits_[static_cast<std::size_t>(found - keys_.begin())];
}

} // namespace gnomon::analysis
