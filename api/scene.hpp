#pragma once

#include "reference_rt/reference_scene.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/light/sun.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"

#include <memory>
#include <mutex>

namespace gnomon::api {

/// A scene for any number of questions. What answers them is made when it is first asked for, and
/// kept. Any number of threads may ask.
class Scene {
public:
    /// The scene that these settings name.
    /// @throws scene::InputError  as `scene::load_scene` does.
    explicit Scene(const scene::SceneSettings& settings);
    /// One that is in memory already.
    explicit Scene(scene::TriangleScene triangles);

    [[nodiscard]] const scene::SceneFile& file() const { return file_; }
    /// The way that is north in it, for a sun.
    [[nodiscard]] const scene::Vec3d& north() const { return north_; }
    [[nodiscard]] const scene::TriangleScene& triangles() const { return file_.scene; }
    /// Serves exact truth.
    /// @throws scene::EnvironmentError  if Embree fails.
    /// @throws scene::InputError        if there is no triangle.
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const;

private:
    scene::SceneFile file_;
    scene::Vec3d north_ = scene::usual_north;
    mutable std::once_flag reference_made_;
    mutable std::unique_ptr<const reference_rt::ReferenceScene> reference_;
};

} // namespace gnomon::api
