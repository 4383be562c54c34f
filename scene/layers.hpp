#pragma once

#include "scene/image.hpp"
#include "scene/pixel_class.hpp"
#include "scene/vec.hpp"

#include <cstdint>

namespace gnomon::scene {

/// What GL's receiver pass saw through the camera.
struct ReceiverLayers {
    Image<std::uint32_t> triangle; ///< GL's triangle T, or `no_triangle`
};

/// What the lookup computed for one pixel; all zero where there is no receiver.
struct LookupSample {
    float receiver_depth = 0; ///< r, before any bias, not clamped
    float map_depth =
        0; ///< d of the centre tap (linear: interpolated); NaN where the policy decided
    float tan_theta = 0; ///< tangent of the angle between geometric normal and light, >= 0, finite
    float verdict = 0;   ///< 1 lit, 0 shadowed, between for filtered lookups
};

struct LookupLayers {
    Image<LookupSample> samples;
};

/// What is true of each pixel.
struct TruthLayers {
    Image<PixelClass> pixel_class;
    Image<ClassReason> reason;
    Image<std::uint32_t> witness; ///< a triangle that blocks, `no_triangle` unless `blocked`
};

/// True when a verdict counts as lit.
[[nodiscard]] constexpr bool is_lit(float verdict)
{
    return verdict >= 0.5F;
}

} // namespace gnomon::scene
