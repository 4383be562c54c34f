#pragma once

#include "scene/image.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/pixels/truth.hpp"
#include "scene/vec.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::scene {

/// The result of GL's receiver pass.
struct ReceiverLayers {
    Image<std::uint32_t> triangle; ///< GL's triangle T, or `no_triangle`
};

/// The lookup's values for one pixel; all zero without a receiver.
struct LookupSample {
    /// r before constant and slope bias; limited to [0, 1] only by `clamp`
    float receiver_depth = 0;
    /// d of the centre tap (linear: interpolated); NaN where the border mode decides
    float map_depth = 0;
    float tan_theta = 0; ///< tangent of the angle between geometric normal and light, >= 0, finite
    float verdict = 0;   ///< 1 lit, 0 shadowed, between for filtered lookups
};

struct LookupLayers {
    Image<LookupSample> samples;
    /// uv · resolution of each lookup, in float32 as computed: the origin is the map's lower left,
    /// and the floor gives the centre texel.
    Image<Vec2f> texels = {};
    MapIndices maps = {}; ///< the map that each lookup reads
    /// `texels` in the next map, for pixels whose verdict is blended with it; NaN at other pixels;
    /// empty without blending.
    Image<Vec2f> next_texels = {};
    Image<Vec2f> kernel_axes = {}; ///< where taps are scattered (`MapPoint::kernel_axis`)

    /// The map point that the pixel's lookup reads.
    [[nodiscard]] MapPoint at(std::size_t pixel) const
    {
        return {texels[pixel], map_of(maps, pixel), axis_of(pixel)};
    }
    /// The point in the next map, if it reads one.
    [[nodiscard]] std::optional<MapPoint> next_at(std::size_t pixel) const
    {
        if (next_texels.empty() || std::isnan(next_texels[pixel].x)) {
            return std::nullopt;
        }
        return MapPoint{next_texels[pixel], map_of(maps, pixel) + 1, axis_of(pixel)};
    }
    /// The axis of the pixel's kernel; 0 unless taps are scattered.
    [[nodiscard]] Vec2f axis_of(std::size_t pixel) const
    {
        return kernel_axes.empty() ? Vec2f{0} : kernel_axes[pixel];
    }
};

/// The effect of bias terms other than constant and slope on each pixel's lookup, in float32.
struct LookupTerms {
    /// xyz: offset of the lookup point [m]. w: depth towards the light, subtracted from the
    /// receiver's (added if reversed). 0 without a receiver.
    Image<Vec4f> moved;
    /// The slope of the taps' reference depths per texel; empty if no term sets one.
    Image<Vec2f> gradients = {};
};

/// A range of a shadow map's texel rows, counted from its lower edge.
struct TexelRows {
    int first = 0;
    int count = 0;
};

} // namespace gnomon::scene
