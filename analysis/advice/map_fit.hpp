#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace gnomon::analysis {

/// The setting that replaces a job's fit, as its file writes it: `fit = "scene"`. In place of a
/// fixed fit, adds a comment to remove the keys of a fixed map, since the file may not have both.
[[nodiscard]] std::string fit_setting(scene::Fit own, scene::Fit fit);

/// The largest distance of receivers in shadow from the middle of a directional light's map, across
/// the light [m]. Their blockers are no farther.
/// @param view      With a map around the middle of the scene.
/// @param triangle  The triangle that each pixel shows.
[[nodiscard]] double reach_of_shadows_m(const scene::TriangleScene& triangles,
                                        const scene::View& view,
                                        const scene::Image<std::uint32_t>& triangle,
                                        const scene::Image<scene::PixelClass>& classes);

/// Half the side of a square map that covers this distance with a tenth to spare, rounded up to two
/// digits [m].
/// @param whole  The map of the whole scene.
/// @return  Empty if nothing is in shadow, or if the square is at least half as wide as the map.
[[nodiscard]] std::optional<double> half_extent_m(double reach_m, const scene::LightFrustum& whole);

} // namespace gnomon::analysis
