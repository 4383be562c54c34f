#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/renderers.hpp"
#include "analysis/results/results.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A scene that both renderers have loaded.
struct OpenScene {
    const scene::SceneFile* file = nullptr;
    const Renderers* renderers = nullptr;
};

/// A curve's job, and the constant biases to evaluate.
struct SweepTask {
    struct Row {
        std::uint64_t ordinal = 0;
        scene::BiasSettings bias;
    };
    std::string id;
    scene::Job job; ///< without the bias axis: its constant bias is the job's own
    std::vector<Row> rows;
};

/// The job's own constant bias [depth units]; 0 if the frustum does not allow it
/// (`scene::resolve_bias`).
[[nodiscard]] float own_constant_bias(const scene::Job& job, const scene::LightFrustum& frustum);

/// A row that cannot be computed, and why.
struct RefusedRow {
    std::uint64_t ordinal = 0;
    std::string message;
};

/// The task's question to its curve. Moves rows with invalid biases from the task to `refused`.
[[nodiscard]] CurveQuestion question_of(SweepTask& task, const scene::LightFrustum& frustum,
                                        std::vector<RefusedRow>& refused);

/// The biases at which to verify a curve, in this order: the job's, the best one, and a few evenly
/// spread rows'; some may be equal.
[[nodiscard]] std::vector<float> wanted_biases(const CurveQuestion& question,
                                               const CurveResult& curve);

[[nodiscard]] std::vector<std::uint64_t> ordinals_of(const SweepTask& task);

} // namespace gnomon::analysis
