#pragma once

#include "analysis/renderers.hpp"
#include "cli/renderers.hpp"
#include "raster_gl/context.hpp"
#include "reference_rt/truth.hpp"
#include "scene/load_scene.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

namespace gnomon::cli {

/// What a session is opened with.
struct SessionOptions {
    std::optional<int> device; ///< EGL device, as `gnomon doctor` numbers them
    int threads = 0;           ///< of the reference; 0: all cores
    reference_rt::TruthMethod method = reference_rt::TruthMethod::exact;
    bool audits = false; ///< float methods will be audited
};

/// A job's scene in both renderers' hands, for any number of comparisons.
class ComparisonSession {
public:
    /// @throws scene::InputError  before memory is taken, if the job needs more than there is; and
    ///                            as `scene::load_scene` does.
    /// @throws scene::EnvironmentError  if GL or Embree fails.
    ComparisonSession(const scene::Job& job, const SessionOptions& options);

    [[nodiscard]] const scene::SceneFile& file() const { return file_; }
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const { return *reference_; }
    /// Valid as long as the session.
    [[nodiscard]] const analysis::Renderers& renderers() const { return renderers_; }
    [[nodiscard]] double scene_seconds() const { return scene_s_; }
    [[nodiscard]] double bvh_seconds() const { return bvh_s_; }

private:
    double scene_s_ = 0;
    double bvh_s_ = 0;
    scene::SceneFile file_;
    raster_gl::Context context_;
    GlRenderer gl_;
    std::unique_ptr<reference_rt::ReferenceScene> reference_;
    analysis::Renderers renderers_;
};

/// Adds --device and --threads.
void add_session_options(CLI::App& command, SessionOptions& options);

} // namespace gnomon::cli
