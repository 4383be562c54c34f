#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/diagnosis/bias_answers.hpp"
#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/results/results.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// The biases to evaluate on one bias curve.
struct CurveQuestion {
    struct Row {
        std::uint64_t ordinal = 0;
        float bias = 0;
    };
    std::string id;
    float slope = 0;    ///< depth units per unit of tan θ
    float job_bias = 0; ///< bias of the job without its sweep axes; gets an error profile
    std::vector<Row> rows;
};

/// Why pixels are wrong, at the job's bias and at every other.
struct Diagnosis {
    scene::Image<float> light_distance_m; ///< light distance of the scored receivers [m], else NaN
    scene::Image<float> map_error_m;      ///< `map_depth_errors_m`
    CauseLayers causes;                   ///< at the job's bias
    Gaps peter_panning;                   ///< at the job's bias
    /// The effect of the other bias terms. Empty if the job has only a constant and a slope, or if
    /// they were not recorded.
    std::optional<scene::LookupTerms> terms;
    /// Empty if biases cannot be evaluated: another renderer's lookup without a formula.
    std::optional<BiasAnswers> biases;
    std::vector<ErrorBin> by_distance; ///< at the job's bias, like the next members
    std::vector<ErrorBin> by_angle;
    std::vector<ObjectErrors> by_object;
    std::vector<MapErrors> by_map;  ///< of several maps, in their order
    std::vector<ErrorBucket> cells; ///< by object and light distance; empty if there are too many
    CurveResult curve;              ///< the result that a sweep keeps, without its id
    /// The errors at the curve's rounded recommendation, by cause and label; empty without one.
    std::optional<NamedErrors> left_by_recommended = {};

    /// The part of the softening at the job's bias that is no error [px].
    [[nodiscard]] Softening left_out() const
    {
        const Softening own{causes.amounts.shadow_softening, causes.amounts.light_softening};
        return curve.softening_at_zero ? analysis::left_out(own, *curve.softening_at_zero) : own;
    }
};

/// The effect of every constant bias on a lookup.
struct KnownCurve {
    CurveResult curve;
    BiasAnswers biases;
    std::optional<NamedErrors> left_by_recommended = {}; ///< `Diagnosis::left_by_recommended`
};

/// Options of a diagnosis.
struct DiagnosisRequest {
    /// The bias of a further error profile, besides the job's own (`CurveQuestion`).
    float profile_bias = 0;
    /// Result for the same lookup at another constant bias, to be reused; null if unknown.
    const KnownCurve* known = nullptr;
};

/// The layers that a comparison found.
struct ComparedLayers {
    const scene::TriangleScene& triangles;
    const scene::ReceiverLayers& receivers;
    const scene::Truth& truth;
    const scene::LookupLayers& lookup;
    /// Verdicts are multiples of 1/this, as in `AmountSum`; 0 for arbitrary fractions of another
    /// renderer.
    int verdict_taps = 0;
};

} // namespace gnomon::analysis
