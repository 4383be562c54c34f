#include "analysis/metrics/peter_panning_gaps.hpp"

namespace gnomon::analysis {

std::vector<PixelGap> gaps_of_pixels(const BlockerGapCache& gaps,
                                     std::span<const std::size_t> pixels,
                                     const ReceiverGeometry& geometry,
                                     const scene::LightFrustum& frustum, int resolution_texels)
{
    std::vector<PixelGap> result;
    result.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        const double texel_m =
            frustum.texel_width_m(geometry.light_distance_m(pixel), resolution_texels);
        result.push_back({static_cast<float>(gaps.gap_m(pixel)),
                          static_cast<float>(gaps.gap_m(pixel) / texel_m)});
    }
    return result;
}

} // namespace gnomon::analysis
