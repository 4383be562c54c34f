#pragma once

#include "scene/camera/camera.hpp"
#include "scene/light/light.hpp"

#include <optional>

namespace gnomon::scene {

/// What a scene file may bring along.
struct SceneDefaults {
    std::optional<CameraSettings> camera;
    std::optional<LightSettings> light;
};

} // namespace gnomon::scene
