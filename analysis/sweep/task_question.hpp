#pragma once

#include "analysis/diagnosis/curve_question.hpp"
#include "analysis/results/results.hpp"
#include "analysis/sweep/sweep_task.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The job's own constant bias [depth units]; 0 where this frustum does not allow it
/// (`scene::resolve_bias`).
[[nodiscard]] float own_constant_bias(const scene::Job& job, const scene::LightFrustum& frustum);

/// A row that cannot be computed, and why.
struct RefusedRow {
    std::uint64_t ordinal = 0;
    std::string message;
};

/// What the task asks of its curve; moves rows without a valid bias from the task to `refused`.
[[nodiscard]] CurveQuestion question_of(SweepTask& task, const scene::LightFrustum& frustum,
                                        std::vector<RefusedRow>& refused);

/// The biases that a curve's numbers are asked for, in this order: the job's, the best one, and a
/// few of the rows' evenly spread over them; some may be equal.
[[nodiscard]] std::vector<float> wanted_biases(const CurveQuestion& question,
                                               const CurveResult& curve);

[[nodiscard]] std::vector<std::uint64_t> ordinals_of(const SweepTask& task);

} // namespace gnomon::analysis
