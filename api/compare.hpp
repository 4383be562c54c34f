#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"
#include "api/loaded_scene.hpp"
#include "raster_gl/context.hpp"
#include "scene/image.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/vec.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace gnomon::api {

/// A job's scene, loaded by both renderers for any number of comparisons.
class ComparisonSession {
public:
    /// @throws scene::InputError  if the job needs more memory than is available, before allocating
    ///                            it; and as `scene::load_scene`.
    /// @throws scene::EnvironmentError  if GL or Embree fails.
    ComparisonSession(const scene::Job& job, const SessionOptions& options);
    /// For a job's several lights, whose comparisons are all kept in memory.
    /// @param jobs  at least one.
    ComparisonSession(std::span<const scene::LightJob> jobs, const SessionOptions& options);
    /// For a scene in memory, to which the jobs' ground and roles are added.
    ComparisonSession(scene::SceneFile scene, std::span<const scene::LightJob> jobs,
                      const SessionOptions& options);

    [[nodiscard]] const scene::SceneFile& file() const { return *file_; }
    /// Shares the file with comparisons that outlive the session.
    [[nodiscard]] const std::shared_ptr<const scene::SceneFile>& shared_file() const
    {
        return file_;
    }
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const
    {
        return loaded_scene_.reference();
    }
    [[nodiscard]] const raster_gl::Context& context() const { return *context_; }
    /// Valid as long as the session.
    [[nodiscard]] const analysis::Renderers& renderers() const { return loaded_scene_.renderers(); }
    [[nodiscard]] const SessionOptions& options() const { return options_; }
    [[nodiscard]] double scene_seconds() const { return scene_s_; }
    [[nodiscard]] double bvh_seconds() const { return loaded_scene_.bvh_seconds(); }

private:
    ComparisonSession(const std::function<scene::SceneFile()>& load, const SessionOptions& options);

    SessionOptions options_;
    double scene_s_ = 0;
    std::shared_ptr<const scene::SceneFile> file_;
    std::shared_ptr<const raster_gl::Context> context_;
    LoadedScene loaded_scene_;
};

/// Optional hooks into comparisons.
struct CompareHooks {
    /// Replaces, or wraps, the session's renderers.
    const analysis::Renderers* renderers = nullptr;
    /// Called with each comparison when it is finished.
    std::function<void(analysis::Comparison&)> finish;
};

/// Compares GL's shadow maps with the truth, for each light of a job.
/// @param jobs  the session's jobs.
/// @return  A comparison for each job. Comparisons refer to the session's scene.
/// @throws scene::InputError, scene::EnvironmentError, std::invalid_argument  as
///                                                                            `analysis::compare_each`.
[[nodiscard]] std::vector<analysis::Comparison> compare(const ComparisonSession& session,
                                                        std::span<const scene::LightJob> jobs,
                                                        const CompareHooks& hooks = {});

/// The point that each pixel shows [m], computed or given by another renderer; NaN for background.
[[nodiscard]] scene::Image<scene::Vec3f> points_of(const analysis::Comparison& comparison);

/// Writes every layer of a configuration to RUN/pixels/ID.exr (docs/aov.md), and the output of
/// `gnomon compare --json` to RUN/pixels/ID.json.
/// @throws scene::EnvironmentError  if a file cannot be written.
void keep_pixels(const std::filesystem::path& folder, std::string_view id,
                 const analysis::Comparison& comparison);

} // namespace gnomon::api
