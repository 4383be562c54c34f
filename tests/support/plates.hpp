#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <vector>

namespace gnomon::tests {

/// A level rectangle in world space [m].
struct Plate {
    double x0 = 0, x1 = 0; ///< x0 < x1
    double z0 = 0, z1 = 0; ///< z0 < z1
    double y = 0;
};

/// A ground at y = 0, x and z from −4 to 4 m, that alone is seen, and plates that alone shadow it
/// and each other.
[[nodiscard]] scene::SceneFile plates_over_ground(const std::vector<Plate>& plates);

/// Looks straight down on the ground, 128 × 128 pixels: with texels of 1/8 m and coordinates that
/// are multiples of that, no pixel's centre and no texel's lies on an edge. The light travels
/// straight down.
/// @param job  with its method; what is seen, the light and the map are set.
[[nodiscard]] scene::Job looking_down(scene::Job job);

} // namespace gnomon::tests
