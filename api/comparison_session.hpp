#pragma once

#include "api/scene_session.hpp"
#include "raster_gl/context.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"

#include <array>
#include <functional>
#include <memory>
#include <span>

namespace gnomon::api {

/// A job's scene, loaded by both renderers, for any number of comparisons.
class ComparisonSession {
public:
    /// @throws scene::InputError  before memory is taken, if the job needs more than there is; and
    ///                            as `scene::load_scene` does.
    /// @throws scene::EnvironmentError  if GL or Embree fails.
    ComparisonSession(const scene::Job& job, const SessionOptions& options);
    /// Of a job's several lights, whose comparisons are kept side by side.
    /// @param jobs  at least one.
    ComparisonSession(std::span<const scene::LightJob> jobs, const SessionOptions& options);
    /// The same of a scene that is in memory, with the ground and the roles that the jobs ask for.
    ComparisonSession(scene::SceneFile scene, std::span<const scene::LightJob> jobs,
                      const SessionOptions& options);

    [[nodiscard]] const scene::SceneFile& file() const { return *file_; }
    /// The same, to be kept with comparisons that outlive the session.
    [[nodiscard]] const std::shared_ptr<const scene::SceneFile>& shared_file() const
    {
        return file_;
    }
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const
    {
        return scene_session_.reference();
    }
    [[nodiscard]] const raster_gl::Context& context() const { return *context_; }
    /// Valid as long as the session.
    [[nodiscard]] const analysis::Renderers& renderers() const
    {
        return scene_session_.renderers();
    }
    [[nodiscard]] const SessionOptions& options() const { return options_; }
    [[nodiscard]] double scene_seconds() const { return scene_s_; }
    [[nodiscard]] double bvh_seconds() const { return scene_session_.bvh_seconds(); }

private:
    ComparisonSession(const std::function<scene::SceneFile()>& load, const SessionOptions& options);

    SessionOptions options_;
    double scene_s_ = 0;
    std::shared_ptr<const scene::SceneFile> file_;
    std::shared_ptr<const raster_gl::Context> context_;
    SceneSession scene_session_;
};

} // namespace gnomon::api
