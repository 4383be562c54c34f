#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"

#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// A group of marked pixels that touch each other, at corners too.
struct PixelCluster {
    std::uint64_t pixels = 0; ///< at least 1
    int x_px = 0;             ///< the group's pixel nearest to its centroid, from the left
    int y_px = 0;             ///< from the top

    friend bool operator==(const PixelCluster&, const PixelCluster&) = default;
};

/// 1 where a scored pixel's verdict is on the wrong side of one half, else 0.
/// @throws std::invalid_argument  if the layers differ in size.
[[nodiscard]] scene::Image<std::uint8_t> wrong_pixels(const scene::Truth& truth,
                                                      const scene::LookupLayers& lookup);

/// The largest group of marked pixels; of equally large ones the first in reading order.
/// @param is_marked  0 where not.
/// @return  Empty if no pixel is marked.
[[nodiscard]] std::optional<PixelCluster>
largest_cluster(const scene::Image<std::uint8_t>& is_marked);

} // namespace gnomon::analysis
