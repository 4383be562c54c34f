#pragma once

#include "scene/settings/job.hpp"

#include <string>

namespace gnomon::analysis {

/// Everything that each stage of a job depends on, as text: jobs share a stage's result if and only
/// if its texts are equal. It takes only the job's keys, so that a sweep can be planned before its
/// scenes are read. Two files share nothing, because their cameras and lights are unknown.
struct StageKeys {
    std::string scene;
    std::string light;   ///< scene and light
    std::string camera;  ///< scene, camera and image
    std::string truth;   ///< scene, light, camera and image
    std::string frustum; ///< the light's matrix; with fit = "camera" also camera and image
    /// Scene, camera, image and, with lookup.position = "vertex", the light and its matrix.
    std::string receivers;
    std::string texels;   ///< the map without its depth format
    std::string map;      ///< empty: no map
    std::string filtered; ///< the method's prefiltering of the map; empty: none
    /// What exact rays depend on: everything but the depth format, the method and its filter.
    std::string exact;
    std::string lookup;
    std::string curve; ///< everything but the constant bias, which counts only without a curve
};

[[nodiscard]] StageKeys stage_keys(const scene::Job& job);

/// The stage keys of a job whose biases GL looks up one by one, to keep its pixels.
[[nodiscard]] StageKeys stage_keys_with_bias(const scene::Job& job);

} // namespace gnomon::analysis
