#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::scene {

/// Planes that are measured at most.
inline constexpr int most_measured_planes = 1 << 22;
/// Tilt that a plane has at most.
inline constexpr double largest_plane_tilt_deg = 80;

/// Planes to measure stored depths on.
struct MeasuredPlaneSettings {
    DepthRange range;
    MapContent content = MapContent::depth; ///< others: of a perspective, not reversed
    int count = 1024;                       ///< planes, one sample each; [1, 2^22]
    double tilt_rad = 0; ///< of the planes about the camera's right axis; [0, 80°]
    double offset_m = 0; ///< the camera stands at (offset, offset, offset); rounded to float32
    int smallest_map_texels = 1024; ///< side of the map, if the planes need no more
};

/// A triangle of each plane, side by side in one map, at distances spread evenly from near to far.
struct MeasuredPlanes {
    TriangleScene triangles; ///< triangle i carries sample i
    LightFrustum frustum;
    int resolution_texels = 0;
    int tile_texels = 0; ///< each triangle has a square tile of the map

    /// Column and row of sample i's texel, counted from the map's top left.
    struct Texel {
        int x = 0;
        int y = 0;
    };
    [[nodiscard]] Texel texel(std::size_t sample) const;
    /// Distance ζ of triangle i's plane at the centre of sample i's texel [m], from the float32
    /// vertices and the camera as composed in double; of maps of distances the distance to the
    /// camera there.
    [[nodiscard]] double light_distance_m(std::size_t sample) const;
};

/// Builds the planes. They keep a few float32 steps away from near and far, and tilted ones as far
/// as their triangles need, so that nothing is clipped.
/// @throws InputError  naming the argument, if count, tilt or offset are out of range, the map
///                     would be larger than 16384, or float32 cannot tell the corners of a triangle
///                     apart.
[[nodiscard]] MeasuredPlanes make_measured_planes(const MeasuredPlaneSettings& settings);

} // namespace gnomon::scene
