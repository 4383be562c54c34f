#pragma once

#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/loaded_scene.hpp"
#include "raster_gl/context.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// The properties of a scene that decide configuration ids, and notes about it.
struct SceneContent {
    std::string hash;    ///< `scene::content_hash`
    std::string normals; ///< `scene::normals_hash`
    scene::SceneDefaults defaults;
    /// By the settings that a job leaves to the file.
    std::map<scene::LeftToFile, std::vector<scene::SceneNote>> notes;
};
[[nodiscard]] SceneContent content_of(const scene::SceneFile& file);

/// Keeps vertex normals if any job of the sweep needs them.
[[nodiscard]] scene::VertexNormals needed_normals(const analysis::SweepCurves& curves);

/// Loads a job's scene.
/// @throws scene::InputError  as `scene::load_scene`.
using SceneLoader =
    std::function<scene::SceneFile(const scene::Job& job, scene::VertexNormals normals)>;

/// The scenes of a sweep, one in memory at a time.
class SweepScenes {
public:
    /// The context must outlive this object.
    /// @param normals  whether vertex normals are kept.
    /// @param load     empty for `scene::load_scene`.
    SweepScenes(const raster_gl::Context& context, const SessionOptions& options,
                scene::VertexNormals normals, SceneLoader load);

    /// The content of the job's scene; loads it unless it was loaded last.
    /// @throws scene::InputError  as `scene::load_scene`.
    [[nodiscard]] SceneContent content(const scene::Job& job);
    /// Opens the job's scene in both renderers and closes the previous one.
    /// @throws scene::InputError, scene::EnvironmentError  as `ComparisonSession`.
    [[nodiscard]] analysis::OpenScene open(const scene::Job& job);

private:
    void read(const scene::Job& job);

    const raster_gl::Context& context_;
    SessionOptions options_;
    scene::VertexNormals normals_;
    SceneLoader load_;
    std::string key_; ///< of the loaded scene
    std::unique_ptr<scene::SceneFile> file_;
    std::optional<LoadedScene> loaded_scene_;
};

} // namespace gnomon::api
