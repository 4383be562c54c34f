#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"

namespace gnomon::scene {

/// The light's camera before it has sides, near and far: where a directional or spot light's
/// stands, and its axes. v grows upwards (towards +z for a light that travels vertically), then the
/// roll turns u and v.
[[nodiscard]] LightFrustum place_light_camera(const FrustumSettings& settings,
                                              const LightSettings& light_settings,
                                              const Light& light, const Box& box);

/// Coordinates of a point along right, up and forward, from the light camera's origin [m].
[[nodiscard]] Vec3d in_light_view(const LightFrustum& frustum, const Vec3d& point);

} // namespace gnomon::scene
