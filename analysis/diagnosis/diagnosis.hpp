#pragma once

#include "analysis/diagnosis/bias_answers.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/named_errors.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/results/results.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::analysis {

class LightQueryCache;

/// Why pixels are wrong, at the job's bias and at every other.
struct Diagnosis {
    scene::Image<float> light_distance_m; ///< light distance of the scored receivers [m], else NaN
    scene::Image<float> map_error_m;      ///< `map_depth_errors_m`
    CauseLayers causes;                   ///< at the job's
    Gaps peter_panning;                   ///< at the job's
    /// What the other bias terms did; empty if the job has only a constant and a slope, or if
    /// nobody recorded it.
    std::optional<scene::LookupTerms> terms;
    /// Empty where nothing knows every bias: another renderer's lookup that has no formula.
    std::optional<BiasAnswers> biases;
    std::vector<ErrorBin> by_distance; ///< at the job's bias, as those below
    std::vector<ErrorBin> by_angle;
    std::vector<ObjectErrors> by_object;
    std::vector<MapErrors> by_map;  ///< of several maps, in their order
    std::vector<ErrorBucket> cells; ///< by object and light distance; empty: too many
    CurveResult curve;              ///< what a sweep keeps of it; without its id
    /// What the curve's recommended bias, as it is pasted, leaves by name; empty: nothing is.
    std::optional<NamedErrors> left_by_recommended = {};

    /// What of the softening at the job's bias is left out of its error [px].
    [[nodiscard]] Softening left_out() const;
};

/// What every constant bias does to a lookup.
struct KnownCurve {
    CurveResult curve;
    BiasAnswers biases;
    std::optional<NamedErrors> left_by_recommended = {}; ///< `Diagnosis::left_by_recommended`
};

/// What is asked of a diagnosis beside the job.
struct DiagnosisRequest {
    /// Beside its own bias, which errors by distance are asked of the curve (`CurveQuestion`).
    float profile_bias = 0;
    /// Of the same lookup with another constant bias, not to be found again; nullptr: not known.
    const KnownCurve* known = nullptr;
};

/// What a comparison found.
struct ComparedLayers {
    const scene::TriangleScene& triangles;
    const scene::ReceiverLayers& receivers;
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    /// What the verdicts are multiples of, as `AmountSum` has it; 0: another renderer's, any
    /// fractions.
    int verdict_taps = 0;
};

} // namespace gnomon::analysis
