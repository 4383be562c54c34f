#pragma once

#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/vec.hpp"

#include <cstdint>

namespace gnomon::scene {

/// A case's image (docs/evaluate.md): another renderer's values for each pixel. Missing images are
/// empty; the others have one size.
struct CaseLayers {
    Image<float> mask; ///< 1 lit, 0 shadowed, between for filtered lookups; 0 without a position
    /// P [the renderer's units]; NaN where nothing is scored. Arbitrary without positions.
    Image<Vec3f> position;
    bool has_positions = true; ///< else P comes from rays through the pixel centres
    Image<Vec3f> normal;       ///< on the visible side, of any length; zero or NaN: unknown
    Image<std::uint32_t> object_number; ///< the renderer's
    Image<float> z_light;               ///< r, before any bias
    Image<float> z_map;                 ///< d; NaN where the border mode decided
    Image<Vec2f> texels;                ///< as `LookupLayers::texels`
    MapIndices maps;                    ///< as `LookupLayers::maps`
    Image<Vec2f> kernel_axes;           ///< as `LookupLayers::kernel_axes`
    Image<float> tan_theta;             ///< as `LookupSample::tan_theta`
    LookupTerms terms;    ///< effect of other bias terms, in metres along our axes; may be empty
    LookupLayers unmoved; ///< the lookup at the receiver itself without any bias; may be empty
    /// Without positions: pixels that are not scored because a silhouette may cross them.
    std::uint64_t silhouette_pixels = 0;
    /// Without positions: 1 where the mask has a value to score, whatever the camera sees there.
    Image<std::uint8_t> is_asked;
    Image<float> map_depths; ///< the shadow maps (`maps_image_size`), top left first

    [[nodiscard]] ImageSize size() const { return position.size(); }
};

} // namespace gnomon::scene
