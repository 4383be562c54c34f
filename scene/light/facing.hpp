#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"

#include <vector>

namespace gnomon::scene {

/// Which way each triangle faces a light, decided exactly: 1 where the light sees its corners
/// counter-clockwise, −1 where clockwise, 0 where the light is in its plane.
///
///     sgn ((b − a) × (c − a))·g   with   g = L − a, or −ℓ of a directional light that travels
///     along ℓ
///
/// @return  By triangle.
[[nodiscard]] std::vector<int> facings(const TriangleScene& triangles, const Light& light);

} // namespace gnomon::scene
