#include "analysis/metrics/peter_panning_gaps.hpp"

namespace gnomon::analysis {

std::vector<PixelGap> gaps_of_pixels(const BlockerGapCache& gaps,
                                     std::span<const std::size_t> pixels,
                                     const ReceiverGeometry& geometry, const MapsOfPixels& maps)
{
    std::vector<PixelGap> result;
    result.reserve(pixels.size());
    for (const std::size_t pixel : pixels) {
        const scene::LightFrustum& map = maps.map_of(pixel);
        const double texel_m =
            map.texel_width_m(map.light_distance_m(geometry.point(pixel)), maps.resolution_texels);
        result.push_back({static_cast<float>(gaps.gap_m(pixel)),
                          static_cast<float>(gaps.gap_m(pixel) / texel_m)});
    }
    return result;
}

} // namespace gnomon::analysis
