#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/scene_identity.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/sweep/sweep.hpp"
#include "cli/renderer/renderer_session.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/run_lock.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::cli {

/// The RUN folder of what another renderer draws: of each configuration a row, which is drawn by
/// itself, whatever it shares with others.
class RendererRun {
public:
    /// Takes the folder before the work is done.
    /// @param space    must outlive this; of one light.
    /// @param options  their folder, texts and flags; --verify and --shard mean nothing here.
    /// @throws scene::InputError, scene::EnvironmentError  as `RunLock` and `RunStore` do.
    RendererRun(const scene::SweepSpace& space, const api::SweepRunOptions& options);

    /// Records what the run is to hold.
    /// @param session  whose scenes name the configurations, and whose renderer is the environment.
    /// @throws scene::InputError  if no configuration can be drawn, or as `RunStore::plan`.
    void plan(RendererSession& session);
    /// What it does not hold yet, ascending.
    [[nodiscard]] std::vector<std::uint64_t> missing();

    /// The job of a configuration, and the keys of it that somebody gave.
    [[nodiscard]] scene::Job job(std::uint64_t ordinal) const;
    [[nodiscard]] std::vector<std::string> given(std::uint64_t ordinal) const;

    void record(std::uint64_t ordinal, const analysis::Comparison& comparison);
    void record_failure(std::uint64_t ordinal, const std::string& message, analysis::Retry retry);

    /// Writes the CSV files, and says how all configurations stand.
    [[nodiscard]] api::SweepOutcome finish();

private:
    [[nodiscard]] analysis::SceneIdentity identify(RendererSession& session, const scene::Job& job);
    [[nodiscard]] store::RunDescription description(const RendererSession& session) const;
    void add(analysis::Configuration configuration);

    const scene::SweepSpace& space_;
    const api::SweepRunOptions& options_;
    store::RunLock lock_;
    analysis::SweepCurves curves_;
    store::RunStore store_;
    std::vector<analysis::Configuration> configurations_;
    std::vector<analysis::Refusal> refusals_;
    std::vector<store::RunNote> notes_;
    api::SweepOutcome outcome_;
};

/// Draws what RUN does not hold yet of a sweep, by one renderer that is started again only if it
/// fails, and records each frame's row as it is judged.
/// @throws scene::EnvironmentError  if the renderer cannot be started again, or as `RendererRun`.
[[nodiscard]] api::SweepOutcome sweep_renderer(const scene::SweepSpace& space,
                                               const api::SweepRunOptions& options,
                                               RendererSession& session, bool is_quiet);

} // namespace gnomon::cli
