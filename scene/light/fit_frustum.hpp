#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"

namespace gnomon::scene {

/// Fits the light's camera.
///
/// `scene`: directional, the smallest light-view box around all vertices; spot, fov = cone.
/// `camera`: directional, the box's sides around what the camera sees of the scene; spot, the
/// narrowest symmetric fov (at most the cone) around what it sees. `fixed`: half_extent_m or
/// fov_deg.
///
/// Auto near and far enclose the ζ of all triangles, clipped to the map's sides, padded by 1e-4 of
/// their range: of what GL finds within the sides nothing is clipped. `camera`: far encloses what
/// the camera sees. Far from the origin the padding grows to what the float32 matrix errs by. A
/// spot's near >= 1e-3 · far, and what is nearer than that is clipped. Where the sides hold nothing
/// that lies on the right side of a given plane, the planes enclose the ζ of all vertices.
/// @throws InputError  if near >= far, or near <= 0 for a spot.
[[nodiscard]] LightFrustum fit_light_frustum(const FrustumSettings& settings,
                                             const LightSettings& light_settings,
                                             const Light& light, const TriangleScene& scene,
                                             const Camera& camera, ImageSize image);

} // namespace gnomon::scene
