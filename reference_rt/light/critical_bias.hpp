#pragma once

#include "reference_rt/exact/bilinear_weights.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "scene/light/exact_light.hpp"
#include "scene/triangles.hpp"

#include <array>
#include <cstddef>

namespace gnomon::reference_rt {

/// The smallest bias that is not below `x`: 0 or a normal float32 of either sign, as GL's biases
/// are; +∞ if `x` is larger than all.
[[nodiscard]] float smallest_bias_from(double x);

/// The depth of a point: bounded, and what makes it exact.
class DepthTerm {
public:
    /// A constant.
    explicit DepthTerm(double constant = 0) : bounded_{constant, 0} {}
    /// Of the hit of a ray with a plane, already bounded; both must outlive the term.
    DepthTerm(const LightDepth& depth, const Receiver& hit, const Bounded& bounded)
        : bounded_{bounded},
          depth_{&depth},
          hit_{&hit}
    {
    }

    [[nodiscard]] Bounded bounded() const { return bounded_; }
    /// Bounded far more closely, at a cost; with an infinite error where the hit is not well
    /// scaled.
    [[nodiscard]] Wide sharp() const;
    [[nodiscard]] Fraction exact() const;
    /// The same, limited to [0, 1].
    [[nodiscard]] DepthTerm clamped() const;

private:
    Bounded bounded_;
    const LightDepth* depth_ = nullptr;
    const Receiver* hit_ = nullptr;
};

/// Finds the smallest bias with which a depth is not in front of a map's, both exact.
class CriticalBias {
public:
    /// All arguments must outlive it.
    CriticalBias(const scene::TriangleScene& triangles, const TexelRays& rays,
                 const LightDepth& depth)
        : triangles_{triangles},
          rays_{rays},
          depth_{depth}
    {
    }

    /// The smallest B with r − B <= d (reversed: r + B >= d), d the depth of the tap; infinite
    /// where the receiver lies in the light's camera plane.
    [[nodiscard]] float find(const DepthTerm& receiver, const scene::ExactTap& tap) const;
    /// The same with d = Σ weight·depth of the taps.
    [[nodiscard]] float find(const DepthTerm& receiver, const std::array<scene::ExactTap, 4>& taps,
                             const BilinearWeights& weights) const;

private:
    /// @param weights  The weights in a precision, which is its argument.
    template <std::size_t n, typename Weights>
    [[nodiscard]] float find(const DepthTerm& receiver, const std::array<scene::ExactTap, n>& taps,
                             const Weights& weights) const;

    const scene::TriangleScene& triangles_;
    const TexelRays& rays_;
    const LightDepth& depth_;
};

} // namespace gnomon::reference_rt
