#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/results/results.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_task.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What a sweep reads from, and where its results go. Each callable is called from one thread at a
/// time.
struct SweepHooks {
    /// Reads the job's scene; the one before it may go.
    std::function<OpenScene(const scene::Job&)> open_scene;
    /// The task of a request.
    std::function<SweepTask(std::size_t curve)> task;
    /// May be empty where `keep_pixels` is not; then nothing is verified.
    std::function<void(FinishedCurve&&)> record;
    /// Configurations that cannot be computed, and why.
    std::function<void(std::span<const std::uint64_t> ordinals, const std::string& message,
                       Retry retry)>
        record_failure;
    /// Asked before each step: true ends the sweep once what has begun is recorded.
    std::function<bool()> should_stop = [] { return false; };
    /// Empty, or told of each configuration's full comparison: GL looks up every bias by itself.
    std::function<void(std::uint64_t ordinal, Comparison&&)> keep_pixels;
    /// Each curve is held to GL's reruns (`verify_biases`): those of the job's bias, the best one
    /// and a few of the rows' are among them.
    bool verifies_biases = false;
    bool counts_cells = true; ///< rows have their errors by object and light distance
};

/// Runs the steps of a plan. GL works on the calling thread; truth-dependent answers are found by
/// another at the same time. The results do not depend on how many threads there are.
///
/// A step that fails with an `InputError` or an `EnvironmentError` fails the configurations that
/// need it, and no others; what `record`, `record_failure` and `keep_pixels` throw ends the sweep.
/// @return  How often each stage ran.
PlanCounts run_sweep(const SweepPlan& plan, const SweepHooks& hooks);

} // namespace gnomon::analysis
