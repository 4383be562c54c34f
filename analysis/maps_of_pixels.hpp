#pragma once

#include "scene/light/frustum.hpp"
#include "scene/map_texels.hpp"

#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// The maps of a light, and which of them each pixel's lookup reads.
struct MapsOfPixels {
    std::span<const scene::LightFrustum> maps;
    const scene::MapIndices& of_pixels;
    int resolution_texels = 0; ///< of each

    [[nodiscard]] const scene::LightFrustum& map_of(std::size_t pixel) const
    {
        return maps[static_cast<std::size_t>(scene::map_of(of_pixels, pixel))];
    }
};

} // namespace gnomon::analysis
