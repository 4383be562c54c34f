#pragma once

#include "scene/light/light.hpp"
#include "scene/view/camera.hpp"

#include <optional>

namespace gnomon::scene {

/// What a scene file may bring along.
struct SceneDefaults {
    std::optional<CameraSettings> camera;
    std::optional<LightSettings> light;
};

} // namespace gnomon::scene
