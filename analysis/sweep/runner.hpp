#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/results/results.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/sweep_task.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace gnomon::analysis {

/// The input and output of a sweep. Each callable runs on one thread at a time.
struct SweepHooks {
    /// Reads the job's scene; may discard the previous one.
    std::function<OpenScene(const scene::Job&)> open_scene;
    /// The task of a request.
    std::function<SweepTask(std::size_t curve)> task;
    /// May be empty if `keep_pixels` is set; then nothing is verified.
    std::function<void(FinishedCurve&&)> record;
    /// Records configurations that cannot be computed, and why.
    std::function<void(std::span<const std::uint64_t> ordinals, const std::string& message,
                       Retry retry)>
        record_failure;
    /// Called before each step; true ends the sweep once work in progress is recorded.
    std::function<bool()> should_stop = [] { return false; };
    /// If set, receives each configuration's full comparison; GL then looks up every bias
    /// separately.
    std::function<void(std::uint64_t ordinal, Comparison&&)> keep_pixels;
    /// Compares each curve with GL's reruns (`verify_biases`) at the job's bias, the best one and a
    /// few of the rows'.
    bool verifies_biases = false;
    bool counts_cells = true; ///< rows hold errors by object and light distance
};

/// Runs the steps of a plan. GL works on the calling thread; other threads find the answers
/// meanwhile. Results do not depend on the number of threads.
///
/// A step that fails with an `InputError` or `EnvironmentError` fails only the configurations that
/// need it. Exceptions of `record`, `record_failure` and `keep_pixels` end the sweep.
/// @return  How often each stage ran.
PlanCounts run_sweep(const SweepPlan& plan, const SweepHooks& hooks);

} // namespace gnomon::analysis
