#pragma once

#include <assimp/camera.h>
#include <assimp/scene.h>

namespace gnomon::scene {

/// The vertical field of view that a glTF file gives its camera [rad]: 0 for an orthographic one.
///
/// Assimp keeps a horizontal one, and its importers disagree on what that is: yfov · aspect ratio
/// (5.2), or 2·atan(tan(yfov / 2) · aspect ratio) (5.4, of glTF 2). Which of them a linked importer
/// computes is tried with a camera whose angle is known.
/// @throws std::runtime_error  if it does not read that one.
[[nodiscard]] double vertical_fov_rad(const aiCamera& camera, const aiScene& scene);

} // namespace gnomon::scene
