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

/// What GL's receiver pass saw through the camera.
struct ReceiverLayers {
    Image<std::uint32_t> triangle; ///< GL's triangle T, or `no_triangle`
};

/// What the lookup computed for one pixel; all zero where there is no receiver.
struct LookupSample {
    /// r, as it is before constant and slope bias; limited to [0, 1] by `clamp` only
    float receiver_depth = 0;
    /// d of the centre tap (linear: interpolated); NaN where the border mode decided
    float map_depth = 0;
    float tan_theta = 0; ///< tangent of the angle between geometric normal and light, >= 0, finite
    float verdict = 0;   ///< 1 lit, 0 shadowed, between for filtered lookups
};

struct LookupLayers {
    Image<LookupSample> samples;
    /// uv · resolution of each lookup, in float32, as the lookup computed it: the origin is at the
    /// map's lower left, the centre texel is the floor.
    Image<Vec2f> texels = {};
    MapIndices maps = {}; ///< which of the light's maps each lookup reads
    /// Where the verdict is mixed with the next map's, the same there; NaN at other pixels; empty
    /// where no maps are mixed.
    Image<Vec2f> next_texels = {};
    Image<Vec2f> kernel_axes = {}; ///< where taps are scattered (`MapPoint::kernel_axis`)

    /// Where the pixel's lookup reads.
    [[nodiscard]] MapPoint at(std::size_t pixel) const
    {
        return {texels[pixel], map_of(maps, pixel), axis_of(pixel)};
    }
    /// Where it reads the next map, or nothing.
    [[nodiscard]] std::optional<MapPoint> next_at(std::size_t pixel) const
    {
        if (next_texels.empty() || std::isnan(next_texels[pixel].x)) {
            return std::nullopt;
        }
        return MapPoint{next_texels[pixel], map_of(maps, pixel) + 1, axis_of(pixel)};
    }
    /// The axis of the pixel's kernel; 0 where taps are not scattered.
    [[nodiscard]] Vec2f axis_of(std::size_t pixel) const
    {
        return kernel_axes.empty() ? Vec2f{0} : kernel_axes[pixel];
    }
};

/// What the bias terms beside constant and slope do to each pixel's lookup, in float32.
struct LookupTerms {
    /// xyz: by how much the point that is looked up is moved [m]; w: the depth that brings it
    /// nearer to the light: taken from the receiver's, reversed added to it. 0 without a receiver.
    Image<Vec4f> moved;
    /// What the depths that taps are compared with rise per texel; empty where no term acts there.
    Image<Vec2f> gradients = {};
};

/// Some of a shadow map's rows of texels, counted from its lower edge.
struct TexelRows {
    int first = 0;
    int count = 0;
};

} // namespace gnomon::scene
