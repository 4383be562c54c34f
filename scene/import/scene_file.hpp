#pragma once

#include "scene/geometry/file_space.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/settings/scene_defaults.hpp"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::scene {

/// What an importer may use; checked before memory is taken.
struct ImportLimits {
    std::chrono::seconds time{60};
    std::uint64_t memory_bytes = 8ULL << 30;
    std::uint64_t triangles = 50'000'000;
};

/// A light that a scene file brings along.
struct FileLight {
    std::string name; ///< its node's; may be empty, or that of another
    LightSettings settings;
};

struct SceneFile {
    TriangleScene scene;
    SceneDefaults defaults; ///< the file's first camera and first punctual light, if any
    std::vector<FileLight> lights = {}; ///< all that a shadow map may be of
};

} // namespace gnomon::scene
