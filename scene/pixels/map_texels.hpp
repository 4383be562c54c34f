#pragma once

#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::scene {

/// The largest number of maps of a light.
inline constexpr std::size_t most_maps = 16;

/// A texel of a shadow map, counted as GL counts: (0, 0) has its centre next to u = v = −1.
struct Texel {
    int x = 0;
    int y = 0;
    int map = 0; ///< index among the light's maps

    friend bool operator==(const Texel&, const Texel&) = default;
};

/// The position of a texel's centre within it.
inline constexpr Vec2d texel_centre{0.5, 0.5};

/// A point of one of a light's maps.
struct MapPoint {
    Vec2f texel; ///< uv · resolution: the origin is at the map's lower left
    int map = 0;
    Vec2f kernel_axis{0}; ///< of a lookup whose taps are scattered: where its kernel's (1, 0) is,
                          ///< from the point [texels]
};

/// For each pixel, the index of the map that its lookup reads; empty if the light has only one.
using MapIndices = Image<std::uint8_t>;

/// The map that a pixel reads.
[[nodiscard]] inline int map_of(const MapIndices& maps, std::size_t pixel)
{
    return maps.empty() ? 0 : maps[pixel];
}

/// Size of an image of all texels of a light's maps: a square for each map, the first on top.
[[nodiscard]] inline ImageSize maps_image_size(int resolution_texels, std::size_t maps)
{
    return {resolution_texels, resolution_texels * static_cast<int>(maps)};
}

/// One map of an image of all texels of a light's maps.
template <typename Pixel>
[[nodiscard]] Image<Pixel> image_of_map(const Image<Pixel>& maps, std::size_t map)
{
    const int side = maps.size().width_px;
    Image<Pixel> one{{side, side}};
    std::copy_n(maps.data() + static_cast<std::ptrdiff_t>(map * one.pixel_count()),
                one.pixel_count(), one.data());
    return one;
}

/// The row of a texel in an image of all texels of a light's maps. Image rows count from the top,
/// texels from the bottom.
[[nodiscard]] inline int image_row(const Texel& texel, int resolution_texels)
{
    return (texel.map + 1) * resolution_texels - 1 - texel.y;
}

/// A texel's pixel in an image of all texels of a light's maps (`maps_image_size`).
template <typename Pixel>
[[nodiscard]] const Pixel& at_texel(const Image<Pixel>& maps, const Texel& texel)
{
    return maps(texel.x, image_row(texel, maps.size().width_px));
}
template <typename Pixel>
[[nodiscard]] Pixel& at_texel(Image<Pixel>& maps, const Texel& texel)
{
    return maps(texel.x, image_row(texel, maps.size().width_px));
}

/// The texel that continues a cube's face beyond its sides; a texel on the face is returned
/// unchanged. raster_gl/shaders/cube_faces.glsl implements the same rule.
///
/// Beyond one side, it is the neighbouring face's texel at the same distance from the seam, in the
/// same row or column. Beyond two sides, at a cube's corner, no texel exists: the larger excess (x
/// if equal) selects the side to cross, and the other coordinate is clamped to the face. Source:
/// OpenGL 4.6 core, 8.14.3, "Seamless cube map filtering". Beyond a whole face's width, the
/// neighbour's last row or column repeats.
[[nodiscard]] Texel texel_across_seams(const Texel& texel, int resolution_texels);

} // namespace gnomon::scene
