#pragma once

#include "scene/geometry/file_space.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/scene_file.hpp"

#include <filesystem>

namespace gnomon::scene {

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
