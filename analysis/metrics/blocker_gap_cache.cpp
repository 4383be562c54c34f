#include "analysis/metrics/blocker_gap_cache.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace gnomon::analysis {

BlockerGapCache::BlockerGapCache(scene::ImageSize size, scene::Cull cull)
    : gaps_m_{size, unknown},
      cull_{cull}
{
}

void BlockerGapCache::find(const renderers::LightQueries& light,
                           std::span<const std::size_t> pixels)
{
    std::vector<std::size_t> asked;
    for (const std::size_t pixel : pixels) {
        if (std::isnan(gaps_m_[pixel])) {
            asked.push_back(pixel);
        }
    }
    const auto blockers = light.find_blockers(asked, cull_);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        gaps_m_[asked[i]] = blockers[i].triangle == scene::no_triangle
                                ? std::numeric_limits<double>::infinity()
                                : blockers[i].gap_m;
    }
}

ForgiveGaps forgive_footprints(BlockerGapCache& gaps, const renderers::LightQueries& light,
                               const ReceiverGeometry& geometry)
{
    return [&](std::span<const std::size_t> pixels) {
        gaps.find(light, pixels);
        std::vector<std::uint8_t> forgiven;
        forgiven.reserve(pixels.size());
        for (const std::size_t pixel : pixels) {
            forgiven.push_back(gaps.gap_m(pixel) <= geometry.footprint_m(pixel) ? 1 : 0);
        }
        return forgiven;
    };
}

} // namespace gnomon::analysis
