#pragma once

#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/scene_session.hpp"
#include "raster_gl/context.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"
#include "scene/settings/scene_defaults.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// What of a scene decides its sweep's ids, and what is to be said of it.
struct SceneContent {
    std::string hash;    ///< `scene::content_hash`
    std::string normals; ///< `scene::normals_hash`
    scene::SceneDefaults defaults;
    /// By what a job may leave to the file.
    std::map<scene::LeftToFile, std::vector<scene::SceneNote>> notes;
};
[[nodiscard]] SceneContent content_of(const scene::SceneFile& file);

/// Kept for all jobs of a sweep where one of them needs them.
[[nodiscard]] scene::VertexNormals needed_normals(const analysis::SweepCurves& curves);

/// Loads a job's scene.
/// @throws scene::InputError  as `scene::load_scene` does.
using SceneLoader =
    std::function<scene::SceneFile(const scene::Job& job, scene::VertexNormals normals)>;

/// The scenes of a sweep, one in memory at a time.
class SweepScenes {
public:
    /// The context must outlive this.
    /// @param normals  kept where a job of the sweep needs them.
    /// @param load     empty: `scene::load_scene`.
    SweepScenes(const raster_gl::Context& context, const SessionOptions& options,
                scene::VertexNormals normals, SceneLoader load);

    /// That of the job's scene, which it reads unless it is the last one read.
    /// @throws scene::InputError  as `scene::load_scene` does.
    [[nodiscard]] SceneContent content(const scene::Job& job);
    /// Hands the job's scene to both renderers; the one before it goes.
    /// @throws scene::InputError, scene::EnvironmentError  as `ComparisonSession` does.
    [[nodiscard]] analysis::OpenScene open(const scene::Job& job);

private:
    void read(const scene::Job& job);

    const raster_gl::Context& context_;
    SessionOptions options_;
    scene::VertexNormals normals_;
    SceneLoader load_;
    std::string key_; ///< of the scene in memory
    std::unique_ptr<scene::SceneFile> file_;
    std::optional<SceneSession> scene_session_;
};

} // namespace gnomon::api
