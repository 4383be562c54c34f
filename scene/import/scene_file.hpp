#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/file_space.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/light/light.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::scene {

/// The camera and light of a scene file.
struct SceneDefaults {
    std::optional<CameraSettings> camera;
    std::optional<LightSettings> light;
};

/// Resources that an importer may use; checked before allocating memory.
struct ImportLimits {
    std::chrono::seconds time{60};
    std::uint64_t memory_bytes = 8ULL << 30;
    std::uint64_t triangles = 50'000'000;
};

/// A light of a scene file.
struct FileLight {
    std::string name; ///< its node's name; may be empty or repeated
    LightSettings settings;
};

struct SceneFile {
    TriangleScene scene;
    SceneDefaults defaults; ///< the file's first camera and first punctual light, if any
    std::vector<FileLight> lights = {}; ///< all lights that can have a shadow map
};

} // namespace gnomon::scene
