#pragma once

#include "scene/import/file_space.hpp"
#include "scene/scene_defaults.hpp"
#include "scene/triangles.hpp"
#include "scene/vertex_normals.hpp"

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

/// Reads a .gltf, .glb, .obj or .ply file.
///
/// The importer runs in a child process under `limits`; only validated flat arrays come back. Node
/// transforms are composed in double, instances flattened, polygons triangulated, points and lines
/// counted and ignored. Object names are node names ("node", "node.2" when repeated).
/// @param normals  kept: the file's own normals at corners, unit in world space, 0 where it has
///                 none; empty where it has none at all.
/// @param space    to which vertices, normals, camera and lights go, in double, before vertices are
///                 rounded.
/// @throws InputError  one line: missing, a folder, empty, refused by the importer, out of limits,
///                     no triangle, a coordinate not finite or beyond 1e15.
[[nodiscard]] SceneFile load_scene_file(const std::filesystem::path& path,
                                        const ImportLimits& limits = {},
                                        VertexNormals normals = VertexNormals::dropped,
                                        const FileSpace& space = {});

} // namespace gnomon::scene
