#pragma once

#include "scene/depth/depth_format.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::scene {

/// The depth that GL stored at a texel, and the exact one.
struct TexelDepth {
    double plane_depth = 0;  ///< exact window depth of the plane through GL's clip positions
    double driver_bound = 0; ///< largest error of GL's depth before the format rounds
    std::uint32_t code = 0;  ///< as `raster_gl::read_codes` returns it
};

/// A texel of a plane whose distance is known.
struct DepthSample {
    double light_distance_m = 0; ///< exact distance at the texel's centre [m]
    TexelDepth texel;
    /// u-formats: the float32 z that the shader quantised; NaN for GL's own formats.
    float shader_depth = std::numeric_limits<float>::quiet_NaN();
};

/// Depths of planes from near to far.
struct DepthMeasurement {
    DepthFormat format;
    std::vector<DepthSample> samples; ///< by growing distance
    std::size_t missing = 0;          ///< planes that GL clipped or moved off their texel
};

/// The largest number of planes.
inline constexpr int most_measured_planes = 1 << 22;
/// The largest tilt of a plane.
inline constexpr double largest_plane_tilt_deg = 80;

/// Planes to measure stored depths on.
struct MeasuredPlaneSettings {
    DepthRange range;
    MapContent content = MapContent::depth; ///< others need a perspective, not reversed
    int count = 1024;                       ///< planes, one sample each; [1, 2^22]
    double tilt_rad = 0; ///< of the planes about the camera's right axis; [0, 80°]
    double offset_m = 0; ///< the camera stands at (offset, offset, offset); rounded to float32
    int smallest_map_texels = 1024; ///< least side of the map
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
    /// vertices and the camera composed in double. For maps of distances, the distance to the
    /// camera.
    [[nodiscard]] double light_distance_m(std::size_t sample) const;
};

/// Builds the planes. They keep a few float32 steps away from near and far, tilted planes more, so
/// that nothing is clipped.
/// @throws InputError  naming the argument, if count, tilt or offset are out of range, the map
///                     would be larger than 16384, or float32 cannot tell the corners of a triangle
///                     apart.
[[nodiscard]] MeasuredPlanes make_measured_planes(const MeasuredPlaneSettings& settings);

} // namespace gnomon::scene
