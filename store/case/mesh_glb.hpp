#pragma once

#include "scene/geometry/triangles.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::store {

/// A scene as binary glTF, without loss: importing it gives the same triangles in the same order,
/// bit by bit, and the same objects by their names; and the same normals, where it has any.
/// @throws scene::InputError  if it takes more than the 4 GiB that the format can hold.
[[nodiscard]] std::vector<std::byte> encode_glb(const scene::TriangleScene& scene);

} // namespace gnomon::store
