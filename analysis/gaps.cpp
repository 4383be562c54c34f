#include "analysis/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::analysis {

namespace {

std::optional<LengthStatistics> statistics_of(std::vector<double> lengths)
{
    if (lengths.empty()) {
        return std::nullopt;
    }
    std::ranges::sort(lengths);
    const auto quantile = [&](double q) {
        const double rank = std::ceil(q * static_cast<double>(lengths.size()));
        return lengths[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
    };
    return LengthStatistics{quantile(0.5), quantile(0.95), lengths.back()};
}

} // namespace

Gaps measure_gaps(const scene::ExactLight& light, std::span<const std::size_t> pixels,
                  const scene::LightFrustum& frustum, int resolution_texels)
{
    std::vector<double> metres;
    std::vector<double> texels;
    for (const scene::BlockerHit& hit : light.find_blockers(pixels)) {
        metres.push_back(hit.gap_m);
        texels.push_back(hit.gap_m / frustum.texel_width_m(hit.receiver_zeta_m, resolution_texels));
    }
    return {statistics_of(std::move(metres)), statistics_of(std::move(texels))};
}

} // namespace gnomon::analysis
