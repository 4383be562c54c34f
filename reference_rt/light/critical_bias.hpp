#pragma once

#include "reference_rt/exact/bilinear_weights.hpp"
#include "reference_rt/light/depth_term.hpp"
#include "renderers/light_queries.hpp"

#include <array>
#include <cstddef>

namespace gnomon::reference_rt {

/// The smallest bias that is not below `x`: 0 or a normal float32 of either sign, as GL's biases
/// are; +∞ if `x` is larger than all.
[[nodiscard]] float smallest_bias_from(double x);

/// Finds the smallest bias with which a depth is not in front of a map's, both exact.
class CriticalBias {
public:
    explicit CriticalBias(const TapDepths& taps) : taps_{taps} {}

    /// The smallest B with r − B <= d (reversed: r + B >= d), d the depth of the tap; infinite
    /// where the receiver lies in the light's camera plane.
    [[nodiscard]] float find(const DepthTerm& receiver, const renderers::ExactTap& tap) const;
    /// The same with d = Σ weight·depth of the taps.
    [[nodiscard]] float find(const DepthTerm& receiver,
                             const std::array<renderers::ExactTap, 4>& taps,
                             const BilinearWeights& weights) const;

private:
    /// @param weights  The weights in a precision, which is its argument.
    template <std::size_t n, typename Weights>
    [[nodiscard]] float find(const DepthTerm& receiver,
                             const std::array<renderers::ExactTap, n>& taps,
                             const Weights& weights) const;

    TapDepths taps_;
};

} // namespace gnomon::reference_rt
