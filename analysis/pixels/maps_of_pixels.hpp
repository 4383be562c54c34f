#pragma once

#include "scene/image.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The light's maps, and the map that each pixel's lookup reads.
struct MapsOfPixels {
    std::span<const scene::LightFrustum> maps;
    const scene::MapIndices& of_pixels;
    int resolution_texels = 0; ///< of each map

    [[nodiscard]] const scene::LightFrustum& map_of(std::size_t pixel) const
    {
        return maps[static_cast<std::size_t>(scene::map_of(of_pixels, pixel))];
    }
};

/// Index of the map that most scored pixels read; on a tie, the first.
[[nodiscard]] inline std::size_t most_read_map(const scene::MapIndices& maps,
                                               const scene::Image<scene::PixelClass>& classes)
{
    std::array<std::size_t, scene::most_maps> readers{};
    for (std::size_t i = 0; i < maps.pixel_count(); ++i) {
        readers.at(maps[i]) += scene::is_scored(classes[i]) ? std::size_t{1} : 0;
    }
    return static_cast<std::size_t>(std::ranges::max_element(readers) - readers.begin());
}

} // namespace gnomon::analysis
