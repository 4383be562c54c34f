#pragma once

#include "api/case_session.hpp"
#include "cli/renderer/protocol/renderer_client.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/source.hpp"
#include "scene/view/view.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A job whose scene a renderer opens, and whose frames are held to the truth.
class CheckScene {
public:
    /// @param source  of the job; it has one light.
    /// @throws scene::InputError  as `scene::make_job` and `scene::load_scene` do.
    explicit CheckScene(const scene::JobSource& source);

    [[nodiscard]] const scene::Job& job() const { return job_; }
    [[nodiscard]] RendererScene scene() const;
    [[nodiscard]] RendererDraw draw(EngineValues engine) const
    {
        return {job_, view_, given_, std::move(engine)};
    }
    /// The same job with other keys, over what it says; its scene, camera, light and image stay.
    [[nodiscard]] CheckScene with(const std::vector<scene::Override>& settings) const;

    /// What is wrong with a frame, as evaluate finds it; empty: nothing.
    [[nodiscard]] std::string complaint(const RendererFrame& frame,
                                        const scene::CaseSpace& space) const;

private:
    scene::JobSource source_;
    scene::Job job_;
    scene::SceneFile file_;
    scene::View view_;
    std::vector<std::string> given_;
};

/// The small scenes of the check, in the order in which they are tried: a wall on ground under a
/// directional light, a spot and a point light, through two cameras.
[[nodiscard]] std::vector<CheckScene> check_scenes();

} // namespace gnomon::cli
