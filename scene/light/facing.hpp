#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"

#include <vector>

namespace gnomon::scene {

/// How each triangle faces a light, decided exactly: 1 if the light sees its corners
/// counter-clockwise, −1 if clockwise, 0 if the light lies in its plane.
///
///     sgn ((b − a) × (c − a))·g   with   g = L − a, or −ℓ of a directional light that travels
///     along ℓ
///
/// @return  By triangle.
[[nodiscard]] std::vector<int> facings(const TriangleScene& triangles, const Light& light);

} // namespace gnomon::scene
