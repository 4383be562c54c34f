#pragma once

#include "scene/depth/depth_format.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::scene {

/// What GL stored at a texel, and what it should have.
struct TexelDepth {
    double plane_depth = 0;  ///< exact window depth of the plane through GL's clip positions
    double driver_bound = 0; ///< how far GL's depth may be from it before the format rounds
    std::uint32_t code = 0;  ///< as `raster_gl::read_codes` gives it
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

} // namespace gnomon::scene
