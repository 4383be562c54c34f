#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/metrics/amounts.hpp"
#include "analysis/recommendation/pasted_bias.hpp"
#include "scene/job/job.hpp"
#include "scene/light/frustum.hpp"

#include <cstddef>
#include <optional>

namespace gnomon::analysis {

/// A constant bias in three units.
struct BiasLength {
    float depth = 0;   ///< depth units
    double metres = 0; ///< along the light's axis, at the median receiver [m]
    double texels = 0; ///< those metres over the world width of a texel there

    friend bool operator==(const BiasLength&, const BiasLength&) = default;
};

/// Biases as lengths: what converts one to metres and texels, a map and its median receiver.
struct BiasLengths {
    scene::LightFrustum frustum;
    int resolution_texels = 0;
    double light_distance_m = 0; ///< median light distance of the scored receivers [m]

    /// A bias in all three units; infinite in each for an infinite bias.
    [[nodiscard]] BiasLength of(float bias) const;
};

/// What verdicts are worth with some setting.
struct Outcome {
    ErrorCounts errors;
    ErrorAmounts amounts;
    double softening = 0; ///< the part of the amounts that a kernel softens borders by [px]

    /// By how much verdicts are wrong beside what a kernel softens on purpose [px].
    [[nodiscard]] double error_amount() const { return amounts.total() - softening; }
};

/// The constant bias to take, and the biases that are nearly as good.
struct Recommendation {
    BiasLength bias; ///< the middle of the valley (docs/bias_curve.md#what-is-recommended)
    BiasLength low;
    BiasLength high;   ///< infinite: nothing limits the bias
    Outcome outcome;   ///< with `bias`
    PastedBias pasted; ///< a bias of the valley with few digits, for people
    BiasLength pasted_length;
    Outcome pasted_outcome;
    std::size_t views = 1; ///< of which it is made; lengths and outcomes are of the job's own
};

/// What is recommended where each verdict is one comparison: amounts are counts.
/// @param settings  The job's biases, which decide the unit to paste.
/// @return  Empty if no scored pixel is lit.
[[nodiscard]] std::optional<Recommendation> recommend_by_count(const BiasCurve& curve,
                                                               const BiasLengths& lengths,
                                                               const scene::BiasSettings& settings);

} // namespace gnomon::analysis
