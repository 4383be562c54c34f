#pragma once

#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"

#include <cstdint>

namespace gnomon::scene {

/// The k-th of a sequence of cameras spread evenly around a given camera.
///
/// Let (a, b, c) be the k-th point of the Halton sequence in bases 2, 3 and 5. The vector from
/// target to eye is turned by α, cos α = 1 − a(1 − cos 60°), towards the angle 2πb between the
/// camera's right and up, and scaled by 2^(c − ½). An orthographic camera's height scales with it.
/// Target and up stay.
/// @param own  The given camera.
/// @param k    From 1.
/// @throws InputError  as `make_camera`, if `own` is not a valid camera.
/// Source: docs/tune.md#views.
[[nodiscard]] CameraSettings nearby_camera(const CameraSettings& own, std::uint32_t k);

/// The k-th of a sequence of lights around a given light, turned by at most 30° by the same rule in
/// bases 2 and 3. Spots and directional lights with a position turn about their target.
/// @param own  Directional or spot.
/// @param k    From 1.
/// @throws InputError  as `make_light`, if `own` is not a valid light.
/// @throws std::invalid_argument  if `own` is a point light.
[[nodiscard]] LightSettings nearby_light(const LightSettings& own, std::uint32_t k);

} // namespace gnomon::scene
