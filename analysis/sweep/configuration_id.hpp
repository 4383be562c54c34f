#pragma once

#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A job's scene in ids: everything that `scene::resolve_view` takes from it.
struct SceneIdentity {
    std::string hash; ///< `scene::content_hash`; empty if the scene cannot be read
    /// The camera, light and normals that the job takes from the scene's file, as text; empty if it
    /// takes none.
    std::string taken_keys;

    /// Equal for scenes that give the job equal results; empty if the scene cannot be read.
    [[nodiscard]] std::string name() const { return hash + taken_keys; }
};

/// @param hash      `scene::content_hash` of the job's scene.
/// @param defaults  Of the scene's file.
/// @param normals   `scene::normals_hash`; counts if the job needs them.
[[nodiscard]] SceneIdentity identify_scene(const scene::Job& job, std::string hash,
                                           const scene::SceneDefaults& defaults,
                                           std::string_view normals = {});

/// Keys and their values as the job file writes them.
using JobParameters = std::vector<std::pair<std::string, std::string>>;

/// The scene's part of an id: its identity, or, if unknown, its file as the job writes it.
[[nodiscard]] std::string scene_in_ids(const SceneIdentity& scene, const JobParameters& given);

/// The id of a configuration: 16 hexadecimal digits, a hash of everything that its results depend
/// on.
/// @param version             Gnomon's.
/// @param scene_name          `scene_in_ids`.
/// @param with_constant_bias  Without it the id is that of its bias curve.
[[nodiscard]] std::string configuration_id(std::string_view version, std::string_view scene_name,
                                           const JobParameters& parameters,
                                           bool with_constant_bias);

} // namespace gnomon::analysis
