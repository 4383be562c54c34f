#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// How a bin's edges follow from those of all bins.
enum class BinScale : std::uint8_t {
    linear,      ///< all equally wide
    logarithmic, ///< each edge is the same factor above the one before; the first is above 0
};

/// Bins side by side, and which scored pixels fall into each.
struct Binning {
    BinScale scale = BinScale::linear;
    double lower = 0;
    double upper = 0;
    int bins = 0;
    scene::ImageSize image;
    std::vector<std::uint32_t> pixels; ///< those of the first bin, of the second, …
    std::vector<std::size_t> ends;     ///< of each bin's pixels
    static constexpr int most_bins = 254;

    [[nodiscard]] std::span<const std::uint32_t> pixels_of(std::size_t bin) const
    {
        const std::size_t first = bin == 0 ? 0 : ends[bin - 1];
        return std::span{pixels}.subspan(first, ends[bin] - first);
    }

    /// The i-th bin's lower edge; for i = `bins` the upper edge of the last.
    [[nodiscard]] double edge(int i) const;
};

/// By light distance ζ [m], over the range of the scored pixels; one bin if they are all equally
/// far, none if there are none.
/// @throws std::invalid_argument  if `bins` is not in [1, 254], the images differ in size, or a
///                                scored pixel's ζ is not finite.
[[nodiscard]] Binning bin_by_distance(const scene::Image<scene::PixelClass>& classes,
                                      const scene::Image<float>& light_distance_m, int bins = 32);

/// By view depth [m], along the camera's axis from the eye; over the range of the scored pixels, by
/// equal factors, as perspective has it; one bin if all are equally deep, none if there are none.
/// @throws std::invalid_argument  as `bin_by_distance`, and if a scored pixel is not before the
/// eye.
[[nodiscard]] Binning bin_by_view_depth(const scene::Image<scene::PixelClass>& classes,
                                        const scene::Image<float>& view_depth_m, int bins);

/// By the receiver's angle θ between geometric normal and light [rad], from 0 to π/2, 5 degrees a
/// bin unless told otherwise.
/// @throws std::invalid_argument  as `bin_by_distance`.
[[nodiscard]] Binning bin_by_angle(const scene::Image<scene::PixelClass>& classes,
                                   const scene::LookupLayers& lookup, int bins = 18);

} // namespace gnomon::analysis
