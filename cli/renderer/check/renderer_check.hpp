#pragma once

#include "api/loaded_case.hpp"
#include "cli/renderer/protocol/renderer_client.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/source.hpp"
#include "scene/view/view.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// A job for the renderer; its frames are compared with the truth.
class CheckScene {
public:
    /// @param source  a job with one light.
    /// @throws scene::InputError  as `scene::make_job` and `scene::load_scene` do.
    explicit CheckScene(const scene::JobSource& source);

    [[nodiscard]] const scene::Job& job() const { return job_; }
    [[nodiscard]] RendererScene scene() const;
    [[nodiscard]] RendererDraw draw(EngineValues engine) const
    {
        return {job_, view_, given_, std::move(engine)};
    }
    /// The job with other settings; they must not change its scene, camera, light or image.
    [[nodiscard]] CheckScene with(const std::vector<scene::Override>& settings) const;

    /// The mistake that `gnomon evaluate` finds in a frame; empty if there is none.
    [[nodiscard]] std::string complaint(const RendererFrame& frame,
                                        const scene::CaseSpace& space) const;

private:
    scene::JobSource source_;
    scene::Job job_;
    scene::SceneFile file_;
    scene::View view_;
    std::vector<std::string> given_;
};

/// The small scenes of the check, in their order: a wall on the ground under a directional, a spot
/// and a point light, from three cameras.
[[nodiscard]] std::vector<CheckScene> check_scenes();

/// Whether a renderer keeps a rule of docs/renderer_protocol.md.
struct RuleFinding {
    std::string rule; ///< "open", "same frame", …
    bool is_kept = true;
    std::string sentence; ///< the evidence
};

/// Starts a renderer and checks every rule on `check_scenes`. A renderer that fails is started
/// again for the remaining rules; rules that need an earlier one are skipped if that failed.
/// @param parent, longest  as for `RendererClient`.
/// @throws scene::EnvironmentError  if the machine fails, not the renderer.
[[nodiscard]] std::vector<RuleFinding> check_renderer(const RendererCommand& command,
                                                      const std::filesystem::path& parent,
                                                      RendererClient::Seconds longest);

} // namespace gnomon::cli
