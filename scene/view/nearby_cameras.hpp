#pragma once

#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"

#include <cstdint>

namespace gnomon::scene {

/// The k-th of a sequence of cameras spread evenly around a camera's own place.
///
/// With a, b, c the k-th point of the Halton sequence in bases 2, 3 and 5, the way from the target
/// to the eye is turned away by α, cos α = 1 − a(1 − cos 60°), towards the side 2πb of the camera's
/// right and up, and made 2^(c − ½) times as long; an orthographic camera's height grows with it.
/// Target and up stay.
/// @param own  With eye, target and up that make a camera.
/// @param k    From 1.
/// @throws InputError  as `make_camera`, if `own` makes no camera.
/// Source: docs/tune.md#views.
[[nodiscard]] CameraSettings nearby_camera(const CameraSettings& own, std::uint32_t k);

/// The k-th of a sequence of lights around a light's own direction: turned by at most 30°, by the
/// same rule in bases 2 and 3. A spot, and a directional light with a position, turns about its
/// target.
/// @param own  Directional or spot.
/// @param k    From 1.
/// @throws InputError  as `make_light`, if `own` makes no light.
/// @throws std::invalid_argument  if it is a point light.
[[nodiscard]] LightSettings nearby_light(const LightSettings& own, std::uint32_t k);

} // namespace gnomon::scene
