#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <optional>

namespace gnomon::analysis {

/// How far receivers in shadow are from the middle of a directional light's map, across the light
/// [m]: what shadows them is no farther.
/// @param view       With a map about the middle of the scene.
/// @param triangle   Of each pixel, what it shows.
[[nodiscard]] double reach_of_shadows_m(const scene::TriangleScene& triangles,
                                        const scene::View& view,
                                        const scene::Image<std::uint32_t>& triangle,
                                        const scene::Image<scene::PixelClass>& classes);

/// Half the side of a square map that reaches so far from its middle, with a tenth to spare and
/// rounded up to two digits [m].
/// @param whole  The map of the whole scene.
/// @return  Empty where nothing is in shadow, or the square is no smaller than half of the map.
[[nodiscard]] std::optional<double> half_extent_m(double reach_m, const scene::LightFrustum& whole);

} // namespace gnomon::analysis
