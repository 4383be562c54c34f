#pragma once

#include "analysis/comparison/comparison.hpp"
#include "api/case_session.hpp"
#include "cli/renderer/last_mask.hpp"
#include "cli/renderer/protocol/renderer_client.hpp"
#include "scene/import/scene_file.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::cli {

/// Where and how a session's renderer runs.
struct RendererSettings {
    RendererCommand command;
    std::filesystem::path parent; ///< its files are in a folder there
    RendererClient::Seconds longest{60};
    int threads = 0; ///< of the reference; 0: all cores
};

/// One renderer that draws any number of jobs, each held to the truth as `gnomon evaluate` holds a
/// case. It is started once, and again only if it ended.
class RendererSession {
public:
    /// Starts it.
    /// @throws RendererFailure, scene::EnvironmentError  as `RendererClient`.
    explicit RendererSession(RendererSettings settings);

    /// What it said of itself when it was started first.
    [[nodiscard]] const RendererHello& hello() const { return hello_; }

    /// Loads the job's scene, unless it is the last one's.
    /// @throws scene::InputError  as `scene::load_scene`.
    [[nodiscard]] const scene::SceneFile& load(const scene::Job& job);

    /// Draws a job and judges the frame. The first frame of a session is drawn twice.
    /// @param given  the keys of the job that somebody gave.
    /// @return  Its scene is valid until another one is loaded. The job holds what the renderer
    ///          did, with the scene and the engine's keys of `job`.
    /// @throws RendererFailure     if the renderer broke a rule; the next call starts it again.
    /// @throws RendererRefusal     if it cannot do what the job says.
    /// @throws scene::InputError   if the job's keys mean nothing in its scene.
    [[nodiscard]] analysis::Comparison compare(const scene::Job& job,
                                               const std::vector<std::string>& given);

    /// Asks the renderer to end; does nothing if it did. One that does not, or not with status 0,
    /// is ended, and a line on standard error says so: its frames were complete.
    void close();

    /// Whether it could not be started when it was tried last.
    [[nodiscard]] bool failed_to_start() const { return failed_to_start_; }

    /// The environment of what it draws.
    [[nodiscard]] analysis::Environment environment() const;

private:
    void start();
    void open(const RendererScene& scene);
    [[nodiscard]] RendererFrame draw(const RendererDraw& draw);
    [[nodiscard]] analysis::Comparison
    judge(const scene::Job& job, const std::vector<std::string>& given, RendererFrame frame);
    [[nodiscard]] const api::CaseMesh& mesh();

    RendererSettings settings_;
    RendererHello hello_;
    std::optional<RendererClient> client_; ///< empty: it failed, and is to be started again
    std::string scene_key_;                ///< of what is loaded
    scene::SceneFile file_;
    std::string opened_; ///< what the renderer has open; empty: nothing
    LastMask last_mask_;
    bool was_drawn_twice_ = false;
    bool failed_to_start_ = false;
    std::unique_ptr<api::CaseMesh> mesh_; ///< of `file_`, in the renderer's space
    scene::CaseSpace mesh_space_;
};

/// The engine's keys, for the table that jobs are read with (`KeyTable::with_engine_keys`).
[[nodiscard]] std::vector<scene::Key> engine_keys(const RendererHello& hello);

/// The values that a job has of the engine's keys, by name without "engine.".
[[nodiscard]] EngineValues engine_values(const scene::Job& job);

} // namespace gnomon::cli
