#pragma once

#include "analysis/bias_curve.hpp"
#include "analysis/bias_limits.hpp"
#include "analysis/breakdown.hpp"
#include "analysis/comparison.hpp"
#include "analysis/sweep/results.hpp"
#include "scene/job.hpp"

#include <cstdint>
#include <string>

namespace gnomon::analysis {

/// A curve, and what its description is made from.
struct DescribedCurve {
    const scene::Job& job;
    const scene::View& view;
    const BiasCurve& curve;
    const BestBiases& best;
    const BiasBounds& bounds;
    const Binning& distances;
    const BreakdownInputs& inputs;
    float job_bias;
};

[[nodiscard]] CurveResult describe_curve(std::string id, const DescribedCurve& described);

/// What a comparison measured, without its parts.
[[nodiscard]] ConfigurationResult result_of(const Comparison& comparison);

/// A configuration's row from its own comparison; the curve from its diagnosis, empty if it is
/// another renderer's and has none.
/// @param job_bias  as in `CurveQuestion`.
[[nodiscard]] FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                                            std::uint64_t ordinal, float job_bias);

} // namespace gnomon::analysis
