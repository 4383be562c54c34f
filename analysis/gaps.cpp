#include "analysis/gaps.hpp"

#include <vector>

namespace gnomon::analysis {

Gaps measure_gaps(const scene::ExactLight& light, std::span<const std::size_t> pixels,
                  const scene::LightFrustum& frustum, int resolution_texels)
{
    std::vector<float> metres;
    std::vector<float> texels;
    for (const scene::BlockerHit& hit : light.find_blockers(pixels)) {
        const double texel_m = frustum.texel_width_m(hit.receiver_zeta_m, resolution_texels);
        metres.push_back(static_cast<float>(hit.gap_m));
        texels.push_back(static_cast<float>(hit.gap_m / texel_m));
    }
    return {find_quantiles(std::move(metres)), find_quantiles(std::move(texels))};
}

} // namespace gnomon::analysis
