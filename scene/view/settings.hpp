#pragma once

#include "scene/job/job.hpp"

namespace gnomon::scene {

/// The camera that a job means: its own, the scene file's, or one that frames the scene.
[[nodiscard]] CameraSettings resolve_camera(const Job& job, const TriangleScene& scene,
                                            const SceneDefaults& defaults);
/// The light that a job means: its own, the scene file's, or the default one.
[[nodiscard]] LightSettings resolve_light(const Job& job, const SceneDefaults& defaults);

} // namespace gnomon::scene
