#pragma once

#include "analysis/sweep/plan.hpp"
#include "api/sweep/sweep.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <cstdint>
#include <string>

namespace gnomon::cli {

/// The size of a sweep and of its work.
struct SweepSummary {
    std::uint64_t configurations = 0; ///< of the whole sweep
    std::uint64_t refused = 0;        ///< those whose keys conflict
    std::string first_refusal;        ///< its message; empty if none is refused
    analysis::PlanCounts counts;      ///< of the work left
    double estimated_seconds = 0;
    std::uint64_t estimated_bytes = 0;
};

/// "1,000 bias.constant × 5 shadow_map.resolution × 2 cases".
[[nodiscard]] std::string axes_text(const scene::SweepSpace& space);

/// How a sweep ended: what is done, what this call did, and what it left.
/// @param folder  RUN
/// @param work    the work of this call.
[[nodiscard]] std::string sweep_outcome_text(const std::string& folder,
                                             const api::SweepOutcome& outcome,
                                             const std::string& work);

[[nodiscard]] std::string plan_text(const scene::SweepSpace& space, const SweepSummary& summary);
[[nodiscard]] std::string plan_json(const SweepSummary& summary);

/// "2 truths, 10 receiver passes, …": how often each stage runs.
[[nodiscard]] std::string counts_text(const analysis::PlanCounts& counts);

} // namespace gnomon::cli
