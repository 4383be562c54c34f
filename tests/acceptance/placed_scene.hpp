#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <ostream>
#include <string>

namespace gnomon::tests {

/// Where a scene is placed, with its camera and light.
struct Placement {
    std::string name;
    double scale = 1;
    double diagonals = 0; ///< moved along (2, −2, 1)/3, after scaling

    friend void PrintTo(const Placement& shown, std::ostream* out) { *out << shown.name; }
};

/// A scene and the job that shows it.
struct Placed {
    scene::Job job;
    scene::SceneFile file;
};

/// Moves and scales a scene, and the points and lengths of its job, in double. Vertices are rounded
/// to float32, and triangles that become degenerate are dropped.
[[nodiscard]] Placed place(const scene::Job& job, const scene::SceneFile& file,
                           const Placement& placement);

} // namespace gnomon::tests
