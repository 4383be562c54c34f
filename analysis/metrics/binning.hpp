#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The spacing of bin edges.
enum class BinScale : std::uint8_t {
    linear,      ///< all bins are equally wide
    logarithmic, ///< each edge is the previous one times a factor; the first is positive
};

/// Adjacent bins, with the scored pixels in each.
struct Binning {
    BinScale scale = BinScale::linear;
    double lower = 0;
    double upper = 0;
    int bins = 0;
    scene::ImageSize image;
    std::vector<std::uint32_t> pixels; ///< by bin
    std::vector<std::size_t> ends;     ///< end of each bin's pixels
    static constexpr int most_bins = 254;

    [[nodiscard]] std::span<const std::uint32_t> pixels_of(std::size_t bin) const
    {
        const std::size_t first = bin == 0 ? 0 : ends[bin - 1];
        return std::span{pixels}.subspan(first, ends[bin] - first);
    }

    /// The i-th bin's lower edge; for i = `bins`, the upper edge of the last bin.
    [[nodiscard]] double edge(int i) const;
};

/// Bins by light distance ζ [m], over the range of the scored pixels. One bin if all are equally
/// far, none without scored pixels.
/// @throws std::invalid_argument  if `bins` is not in [1, 254], if the images differ in size, or if
///                                a scored pixel's ζ is not finite.
[[nodiscard]] Binning bin_by_distance(const scene::Image<scene::PixelClass>& classes,
                                      const scene::Image<float>& light_distance_m, int bins = 32);

/// Bins by view depth [m], along the camera's axis from the eye, over the range of the scored
/// pixels. Edges grow by equal factors, which suits perspective. One bin if all are equally deep,
/// none without scored pixels.
/// @throws std::invalid_argument  as `bin_by_distance`, and if a scored pixel is not in front of
///                                the eye.
[[nodiscard]] Binning bin_by_view_depth(const scene::Image<scene::PixelClass>& classes,
                                        const scene::Image<float>& view_depth_m, int bins);

/// Bins by the receiver's angle θ between geometric normal and light [rad], from 0 to π/2; by
/// default 5 degrees wide.
/// @throws std::invalid_argument  as `bin_by_distance`.
[[nodiscard]] Binning bin_by_angle(const scene::Image<scene::PixelClass>& classes,
                                   const scene::LookupLayers& lookup, int bins = 18);

} // namespace gnomon::analysis
