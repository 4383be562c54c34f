#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/sweep_curves.hpp"
#include "api/sweep/sweep.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/run/run_store.hpp"
#include "store/run_folder/run_lock.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::cli {

/// Records another renderer's frames in a RUN folder, a row for each configuration.
class FrameRecorder {
public:
    /// Locks the folder, before the work begins.
    /// @param space    must outlive this; it has one light.
    /// @param options  folder, texts and flags; --verify and --shard are ignored.
    /// @throws scene::InputError, scene::EnvironmentError  as `RunLock` and `RunStore` do.
    FrameRecorder(const scene::SweepSpace& space, const api::SweepRunOptions& options);

    /// Records the configurations.
    /// @param renderer  loads their scenes, and is the run's environment.
    /// @throws scene::InputError  if no configuration can be drawn, or as `RunStore::plan`.
    void plan(DrivenRenderer& renderer);
    /// The ordinals without results, ascending.
    [[nodiscard]] std::vector<std::uint64_t> missing();

    [[nodiscard]] scene::Job job(std::uint64_t ordinal) const;
    /// The keys that the user set.
    [[nodiscard]] std::vector<std::string> given(std::uint64_t ordinal) const;

    void record(std::uint64_t ordinal, const analysis::Comparison& comparison);
    void record_failure(std::uint64_t ordinal, const std::string& message, analysis::Retry retry);

    /// Writes the CSV files.
    [[nodiscard]] api::SweepOutcome finish();

private:
    [[nodiscard]] analysis::SceneIdentity identify(DrivenRenderer& renderer, const scene::Job& job);
    [[nodiscard]] store::RunDescription description(const DrivenRenderer& renderer) const;
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

/// Draws the missing configurations of a sweep with another renderer, and records each at once.
/// @throws scene::EnvironmentError  if the renderer cannot be started again, or as `FrameRecorder`.
[[nodiscard]] api::SweepOutcome sweep_renderer(const scene::SweepSpace& space,
                                               const api::SweepRunOptions& options,
                                               DrivenRenderer& renderer, bool is_quiet);

/// `api::sweep` with progress on stderr; a signal stops it where it can resume.
[[nodiscard]] api::SweepOutcome watched_sweep(const scene::SweepSpace& space,
                                              const api::SweepRunOptions& options, bool is_quiet);

} // namespace gnomon::cli
