#pragma once

#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <string>
#include <string_view>

namespace gnomon::analysis {

/// What stands for a job's scene in ids: everything that `scene::resolve_view` takes from it.
struct SceneIdentity {
    std::string hash; ///< `scene::content_hash`; empty if the scene cannot be read
    /// The camera and the light that the job leaves to the scene's file, and the normals that it
    /// looks up along, as text; empty if the job has its own, or the file none.
    std::string taken_keys;

    /// Equal for scenes that give the job equal results; empty if the scene cannot be read.
    [[nodiscard]] std::string name() const { return hash + taken_keys; }
};

/// @param hash      `scene::content_hash` of the job's scene.
/// @param defaults  that its file brings along.
/// @param normals   `scene::normals_hash`; counts where the job needs them.
[[nodiscard]] SceneIdentity identify_scene(const scene::Job& job, std::string hash,
                                           const scene::SceneDefaults& defaults,
                                           std::string_view normals = {});

} // namespace gnomon::analysis
