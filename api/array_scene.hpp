#pragma once

#include "api/scene.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon::api {

/// Of a triangle's corners, counter-clockwise seen from outside.
using TriangleIndices = std::array<std::uint32_t, 3>;

/// A run of triangles that is an object.
struct NamedTriangles {
    std::string name;
    std::int64_t count = 0;
};

/// A scene, and which of the given triangles it has.
struct ArrayScene {
    std::shared_ptr<Scene> scene;
    std::vector<std::uint32_t> kept; ///< indices, in order: those that have an area in float32
};

/// A scene of triangles in memory, whose corners are rounded to float32 once.
/// @param objects  in the order of the triangles, every one of which they hold; empty: all are one,
///                 "mesh".
/// @param no_cast, no_receive  names of objects that cast no shadow, and that are not seen.
/// @throws scene::InputError  naming vertex, triangle or object, if a coordinate is not finite or
///                            beyond 1e15, if an index has no vertex, or if no triangle has an
///                            area.
[[nodiscard]] ArrayScene make_array_scene(std::span<const scene::Vec3d> vertices,
                                          std::span<const TriangleIndices> triangles,
                                          std::vector<NamedTriangles> objects = {},
                                          const std::vector<std::string>& no_cast = {},
                                          const std::vector<std::string>& no_receive = {});

} // namespace gnomon::api
