#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/job.hpp"

namespace gnomon::reference_rt {

/// True when the culling leaves triangles of which the light sees the side `light_side`: front,
/// counter-clockwise, is 1. Edge-on ones have nothing to leave.
[[nodiscard]] constexpr bool is_left(scene::Cull cull, Sign light_side)
{
    switch (cull) {
    case scene::Cull::none:
        return light_side != 0;
    case scene::Cull::front:
        return light_side < 0;
    case scene::Cull::back:
        return light_side > 0;
    }
    return false; // not reached
}

/// True when the segment P→light crosses the plane of S in front of the light and at a matrix depth
/// in [0, 1]. Precondition: it crosses that plane between P and the light.
///
/// With g the way from P to the light, the crossing X is, for a matrix row R,
///
///     R·X = (h R·P − H R·λ) / (h − H or h),   H = M·(P − u), h = M·g(u), M = (v − u) × (w − u)
///
/// where the light λ is (L, 1) and the divisor h − H, or λ is (−ℓ, 0) and the divisor h: both have
/// the sign of h, as H has the other.
[[nodiscard]] bool crosses_in_range(const Receiver& receiver, const Corners& s,
                                    const scene::Light& light, const LightDepth& depth,
                                    SignCounts& counts);

/// Where the segment P→light crosses the plane of S, to a relative 2^-42: the part of the way from
/// P to a spot, in (0, 1), or the multiple of −ℓ, above 0. Precondition: as above.
[[nodiscard]] double way_to_crossing(const Receiver& receiver, const Corners& s,
                                     const scene::Light& light);

} // namespace gnomon::reference_rt
