#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/metrics/metrics.hpp"
#include "api/loaded_case.hpp"
#include "cli/options/job_options.hpp"
#include "cli/renderer/protocol/renderer_client.hpp"
#include "cli/renderer/renderer_options.hpp"
#include "scene/image.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::cli {

/// Remembers a renderer's last mask, to notice when the next scene gets the same one.
class LastMask {
public:
    /// Stores the next mask.
    /// @param opened  the `open` request that it was drawn for.
    /// @return  Whether it equals the last one bit by bit, though the request differs.
    [[nodiscard]] bool take(const scene::Image<float>& mask, const std::string& opened);

    /// Stores the metrics of the same mask.
    /// @return  Whether it must differ from the last one: the number of blocked pixels differs by
    ///          over 1 % of the scored ones. False for a mask that is all lit or all shadow, which
    ///          many scenes share.
    [[nodiscard]] bool must_differ(const analysis::Metrics& measured);

private:
    scene::Image<float> mask_;
    std::string opened_;
    std::uint64_t blocked_ = 0;
};

/// How a `DrivenRenderer` is started.
struct RendererSettings {
    RendererCommand command;
    std::filesystem::path parent; ///< of the folder for its temporary files
    RendererClient::Seconds longest{60};
    int threads = 0; ///< of the reference; 0: all cores
};

/// A renderer process that draws any number of jobs; each frame is evaluated as `gnomon evaluate`
/// does. If the process ends, it is started again.
class DrivenRenderer {
public:
    /// Starts it.
    /// @throws RendererFailure, scene::EnvironmentError  as `RendererClient`.
    explicit DrivenRenderer(RendererSettings settings);

    /// Its first answer to `hello`.
    [[nodiscard]] const RendererHello& hello() const { return hello_; }

    /// Loads the job's scene, unless it is loaded already.
    /// @throws scene::InputError  as `scene::load_scene`.
    [[nodiscard]] const scene::SceneFile& load(const scene::Job& job);

    /// Draws a job and evaluates the frame. The very first frame is drawn twice.
    /// @param given  the keys of the job that the user set.
    /// @return  Refers to the loaded scene. Its job holds the settings that the renderer used, with
    ///          the scene and the engine's keys of `job`.
    /// @throws RendererFailure     if the renderer broke a rule; the next call starts it again.
    /// @throws RendererRefusal     if it cannot do what the job asks for.
    /// @throws scene::InputError   if the job's keys do not fit its scene.
    [[nodiscard]] analysis::Comparison compare(const scene::Job& job,
                                               const std::vector<std::string>& given);

    /// Asks the renderer to end, if it runs. If it does not, or fails, it is killed and a line on
    /// stderr says so: its frames were complete.
    void close();

    /// Whether the last attempt to start it failed.
    [[nodiscard]] bool failed_to_start() const { return failed_to_start_; }

    /// The environment of what it draws.
    [[nodiscard]] analysis::Environment environment() const;

private:
    void start();
    void open(const RendererScene& scene);
    [[nodiscard]] RendererFrame draw(const RendererDraw& draw);
    [[nodiscard]] analysis::Comparison
    evaluate(const scene::Job& job, const std::vector<std::string>& given, RendererFrame frame);
    [[nodiscard]] const api::CaseMesh& mesh();

    RendererSettings settings_;
    RendererHello hello_;
    std::optional<RendererClient> client_; ///< empty after a failure, until it is started again
    std::string scene_key_;                ///< of `file_`
    scene::SceneFile file_;
    std::string opened_; ///< the last successful `open` request
    LastMask last_mask_;
    bool was_drawn_twice_ = false;
    bool failed_to_start_ = false;
    std::unique_ptr<api::CaseMesh> mesh_; ///< of `file_`, in the renderer's space
    scene::CaseSpace mesh_space_;
};

/// The engine's keys, for `KeyTable::with_engine_keys`.
[[nodiscard]] std::vector<scene::Key> engine_keys(const RendererHello& hello);

/// The job's values of the engine's keys.
[[nodiscard]] EngineValues engine_values(const scene::Job& job);

/// The settings of a command. Temporary files go to TMPDIR because its path is short: browsers
/// create sockets there, whose paths have at most 107 bytes.
[[nodiscard]] RendererSettings renderer_settings(RendererCommand command,
                                                 const RendererOptions& options, int threads);

/// Reads a job for the renderer, including the engine's keys.
/// @throws scene::InputError  as `read_any_job_source`, and for a job with several lights.
[[nodiscard]] scene::JobSource read_driven_job(const DrivenRenderer& renderer,
                                               const JobOptions& options);

/// The job as a space of one configuration, without its sweep and its other cases.
/// @throws scene::InputError  as `scene::SweepSpace`.
[[nodiscard]] scene::SweepSpace space_of_one(scene::JobSource source, const std::string& case_name);

/// Requires that no option is given that only GL supports.
/// @param options  their names, and whether they are given.
/// @throws scene::InputError  naming the first that is.
void refuse_for_renderer(std::initializer_list<std::pair<std::string_view, bool>> options);

[[nodiscard]] std::vector<std::string>
key_names(const std::vector<std::pair<std::string, std::string>>& keys);

} // namespace gnomon::cli
