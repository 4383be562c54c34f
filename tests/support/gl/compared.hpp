#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/loaded_scene.hpp"
#include "gl_case.hpp"
#include "methods/job_method.hpp"
#include "scene/job/file.hpp"
#include "scene/load/load_scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::tests {

/// A scene that both renderers have loaded, to be compared with any number of jobs.
class Compared {
public:
    explicit Compared(const scene::Job& job)
        : Compared{scene::load_scene(job.scene, methods::vertex_normals(job))}
    {
    }
    explicit Compared(scene::SceneFile file);

    /// @param job  Must show this scene.
    [[nodiscard]] analysis::Comparison operator()(const scene::Job& job) const;
    /// Without causes and curves: faster.
    [[nodiscard]] analysis::Comparison without_diagnosis(const scene::Job& job) const;
    [[nodiscard]] const analysis::Renderers& renderers() const { return session_->renderers(); }
    /// Draws the receivers and the map.
    [[nodiscard]] renderers::Drawn drawn(const scene::Job& job, const scene::View& view) const;
    [[nodiscard]] const scene::SceneFile& file() const { return file_; }

private:
    scene::SceneFile file_;
    std::unique_ptr<api::LoadedScene> session_;
};

} // namespace gnomon::tests
