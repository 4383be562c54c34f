#pragma once

#include "scene/geometry/file_space.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "scene/import/process.hpp"
#include "scene/import/scene_file.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace gnomon::scene {

/// Reads a .gltf, .glb, .obj or .ply file.
///
/// The importer runs in a child process under `limits` and returns only validated flat arrays. Node
/// transforms are composed in double, instances flattened, polygons triangulated; points and lines
/// are counted and ignored. Object names are node names ("node", "node.2" when repeated).
/// @param normals  kept: the file's normals at corners, unit in world space, 0 where one is
///                 missing; empty if the file has none.
/// @param space    converts vertices, normals, camera and lights, in double, before vertices are
///                 rounded.
/// @throws InputError  one line: missing, a folder, empty, refused by the importer, out of limits,
///                     no triangle, a coordinate not finite or beyond 1e15.
[[nodiscard]] SceneFile load_scene_file(const std::filesystem::path& path,
                                        const ImportLimits& limits = {},
                                        VertexNormals normals = VertexNormals::dropped,
                                        const FileSpace& space = {});

/// The import stream of a scene file, which may be a refusal.
/// @throws InputError  if the file cannot be opened, or the importer crashed or exceeded a limit.
[[nodiscard]] SealedBytes pack_scene_file(const std::filesystem::path& path,
                                          const ImportLimits& limits, VertexNormals normals);

/// Decodes an import stream: the result of `load_scene_file` for that file.
/// @param path    of that file, for messages and names; need not exist.
/// @param packed  aligned to 8.
/// @param space   `load_scene_file`'s.
/// @throws InputError  as `load_scene_file`.
[[nodiscard]] SceneFile unpack_scene_file(const std::filesystem::path& path,
                                          std::span<const std::byte> packed,
                                          const ImportLimits& limits, const FileSpace& space = {});

} // namespace gnomon::scene
