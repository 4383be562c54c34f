#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <string>
#include <vector>

namespace gnomon::analysis {

/// Finds the objects that enclose a positional light and shadow nearly everything, like the mesh of
/// its own bulb: at most one scored pixel in a hundred is lit.
///
/// An object encloses the light if rays from the light meet it in at least 15 of 16 directions,
/// spread evenly over the sphere; if it stands between the light and at least 19 of 20 blocked
/// points of other objects; and if at most half of the scored pixels show the object itself. A room
/// around light and camera fails the second condition. A room whose neighbour the camera views
/// fails the last.
/// @param receivers  GL's triangle of each pixel.
/// @return  Their names, in the order of the scene; empty for a directional light.
[[nodiscard]] std::vector<std::string>
objects_around_light(const scene::TriangleScene& triangles, const scene::View& view,
                     const scene::Image<std::uint32_t>& receivers,
                     const scene::Image<scene::PixelClass>& classes);

} // namespace gnomon::analysis
