#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"

namespace gnomon::scene {

/// The position and axes of a directional or spot light's camera, without sides, near and far. v
/// grows upwards (towards +z for vertical light), then the roll turns u and v.
[[nodiscard]] LightFrustum place_light_camera(const FrustumSettings& settings,
                                              const LightSettings& light_settings,
                                              const Light& light, const Box& box);

/// Coordinates of a point along right, up and forward, from the light camera's origin [m].
[[nodiscard]] Vec3d in_light_view(const LightFrustum& frustum, const Vec3d& point);

/// Fits the light's camera.
///
/// `scene`: directional, the smallest light-view box around all vertices; spot, fov = cone.
/// `camera`: directional, the box's sides enclose the visible part of the scene; spot, the
/// narrowest symmetric fov (at most the cone) that does. `fixed`: half_extent_m or fov_deg.
///
/// Auto near and far enclose the ζ of all triangles, clipped to the map's sides, padded by 1e-4 of
/// their range, so that GL clips nothing within the sides. `camera`: far encloses what the camera
/// sees. Far from the origin the padding grows to the error of the float32 matrix. A spot's near is
/// at least 1e-3 · far; nearer geometry is clipped. If the sides hold nothing on the right side of
/// a given plane, the planes enclose the ζ of all vertices.
/// @throws InputError  if near >= far, or near <= 0 for a spot.
[[nodiscard]] LightFrustum fit_light_frustum(const FrustumSettings& settings,
                                             const LightSettings& light_settings,
                                             const Light& light, const TriangleScene& scene,
                                             const Camera& camera, ImageSize image);

} // namespace gnomon::scene
