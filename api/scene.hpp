#pragma once

#include "reference_rt/reference_scene.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/light/light.hpp"
#include "scene/light/sun.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace gnomon::api {

/// A scene that builds its acceleration structure on first use and keeps it. Thread-safe.
class Scene {
public:
    /// Loads the scene that these settings name.
    /// @throws scene::InputError  as `scene::load_scene`.
    explicit Scene(const scene::SceneSettings& settings);
    /// Takes a scene in memory.
    explicit Scene(scene::TriangleScene triangles);

    [[nodiscard]] const scene::SceneFile& file() const { return file_; }
    /// The direction of north, for a sun.
    [[nodiscard]] const scene::Vec3d& north() const { return north_; }
    [[nodiscard]] const scene::TriangleScene& triangles() const { return file_.scene; }
    /// The reference scene for exact truth.
    /// @throws scene::EnvironmentError  if Embree fails.
    /// @throws scene::InputError        if the scene has no triangles.
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const;

private:
    scene::SceneFile file_;
    scene::Vec3d north_ = scene::usual_north;
    mutable std::once_flag reference_made_;
    mutable std::unique_ptr<const reference_rt::ReferenceScene> reference_;
};

/// Vertex indices of a triangle, counter-clockwise seen from outside.
using TriangleIndices = std::array<std::uint32_t, 3>;

/// A run of triangles that forms an object.
struct NamedTriangles {
    std::string name;
    std::int64_t count = 0;
};

/// A scene, and which of the given triangles it kept.
struct ArrayScene {
    std::shared_ptr<Scene> scene;
    std::vector<std::uint32_t> kept; ///< indices of triangles with an area in float32, ascending
};

/// Makes a scene of triangles in memory; rounds corners to float32 once.
/// @param objects  in the order of the triangles, covering all of them; empty for a single object
///                 "mesh".
/// @param no_cast, no_receive  names of objects that cast no shadow, and of objects that receive
///                             none.
/// @throws scene::InputError  naming the vertex, triangle or object, if a coordinate is not finite
///                            or beyond 1e15, an index is out of range, or no triangle has an area.
[[nodiscard]] ArrayScene make_array_scene(std::span<const scene::Vec3d> vertices,
                                          std::span<const TriangleIndices> triangles,
                                          std::vector<NamedTriangles> objects = {},
                                          const std::vector<std::string>& no_cast = {},
                                          const std::vector<std::string>& no_receive = {});

/// Makes a light with its numbers as doubles, which `scene::make_light` would round to float32.
/// @throws scene::InputError  as `scene::make_light`.
[[nodiscard]] scene::Light make_light_of_doubles(const scene::LightSettings& settings);

} // namespace gnomon::api
