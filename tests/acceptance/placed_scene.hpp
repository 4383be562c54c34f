#pragma once

#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <ostream>
#include <string>

namespace gnomon::tests {

/// Where a scene is put, camera and light with it.
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

/// Moves and scales a scene, in double, and all of its job that is a point or a length. Vertices
/// are rounded to float32 anew, and triangles that lose their area are dropped.
[[nodiscard]] Placed place(const scene::Job& job, const scene::SceneFile& file,
                           const Placement& placement);

} // namespace gnomon::tests
