#pragma once

#include "analysis/metrics/blocker_gap_cache.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/pixels/quantiles.hpp"
#include "analysis/pixels/receiver_geometry.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// Peter-panning of one pixel as a length.
struct PixelGap {
    float metres = 0; ///< from P to its blocker; infinite where the culling leaves none
    float texels = 0; ///< in texels' world widths at P
};

/// Peter-panning as a length; empty if no pixel has a gap.
struct Gaps {
    std::optional<Quantiles> metres;
    std::optional<Quantiles> texels;
};

/// @param pixels  blocked in truth; their gaps must be known.
[[nodiscard]] std::vector<PixelGap> gaps_of_pixels(const BlockerGapCache& gaps,
                                                   std::span<const std::size_t> pixels,
                                                   const ReceiverGeometry& geometry,
                                                   const MapsOfPixels& maps);

} // namespace gnomon::analysis
