#pragma once

#include "scene/settings/job.hpp"

#include <string>

namespace gnomon::analysis {

/// What each stage of a job depends on, as text: two jobs share a stage's result iff its texts are
/// equal. Made of the job's keys alone, so that a sweep can be planned before a scene is read; two
/// files share nothing, for what cameras and lights they bring along is not known.
struct StageKeys {
    std::string scene;
    std::string light;   ///< scene and light
    std::string camera;  ///< scene, camera and image
    std::string truth;   ///< scene, light, camera and image
    std::string frustum; ///< the light's matrix: with fit = "camera" also camera and image
    /// Scene, camera, image and, with lookup.position = "vertex", the light and its matrix.
    std::string receivers;
    std::string texels;   ///< the map but for its depth format
    std::string map;      ///< empty: there is none
    std::string filtered; ///< what the method makes of the map; empty: nothing
    /// What exact rays say of a lookup: everything but the depth format, and what the method and
    /// its filter make of the depths.
    std::string exact;
    std::string lookup;
    std::string curve; ///< everything but the constant bias; without a curve that too
};

[[nodiscard]] StageKeys stage_keys(const scene::Job& job);

/// The stage keys of a job of which GL looks up every bias by itself, to keep its pixels.
[[nodiscard]] StageKeys stage_keys_with_bias(const scene::Job& job);

} // namespace gnomon::analysis
