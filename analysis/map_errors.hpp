#pragma once

#include "analysis/causes.hpp"
#include "scene/image.hpp"
#include "scene/job.hpp"
#include "scene/light_frustum.hpp"

namespace gnomon::analysis {

/// The depth error of the map at each scored pixel's centre texel: light distance that the stored
/// depth stands for, less the exact one of what the light sees through the texel's centre [m].
///
/// NaN where the pixel is not scored, where there is no texel, or where either sees nothing.
/// @throws std::invalid_argument  as `find_causes` does.
/// Source: DESIGN §6.
[[nodiscard]] scene::Image<float> map_depth_errors_m(const CauseInputs& inputs,
                                                     const scene::LightFrustum& frustum,
                                                     scene::DepthFormat format);

/// The light distance that a depth stands for [m]: ζ = near + d·(far − near) for a directional
/// light, 1/ζ = 1/near − (1/near − 1/far)·d for a spot; reversed depths count from far.
[[nodiscard]] double zeta_of_depth_m(const scene::LightFrustum& frustum, double depth);

} // namespace gnomon::analysis
