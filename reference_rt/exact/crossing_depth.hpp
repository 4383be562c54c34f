#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "scene/light/light.hpp"
#include "scene/settings/job.hpp"

namespace gnomon::reference_rt {

/// Whether culling keeps a triangle whose side `light_side` faces the light: 1 is the front,
/// counter-clockwise. Edge-on triangles are kept by none.
[[nodiscard]] constexpr bool is_kept_by_culling(scene::Cull cull, Sign light_side)
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

/// Whether the segment P→light crosses the plane of S in front of the light at a matrix depth in
/// [0, 1]. Precondition: it crosses that plane between P and the light.
///
/// With g the vector from P to the light, the crossing X satisfies, for a matrix row R,
///
///     R·X = (h R·P − H R·λ) / (h − H or h),   H = M·(P − u), h = M·g(u), M = (v − u) × (w − u)
///
/// with λ = (L, 1) and divisor h − H for a positional light, or λ = (−ℓ, 0) and divisor h for a
/// directional one. Both divisors have the sign of h, as H has the opposite sign.
[[nodiscard]] bool crosses_in_range(const Receiver& receiver, const Corners& s,
                                    const scene::Light& light, const LightDepth& depth,
                                    SignCounts& counts);

/// The parameter where the segment P→light crosses the plane of S, to a relative 2^-42: the
/// fraction of the way to a positional light, in (0, 1), or the multiple of −ℓ, > 0. Precondition:
/// as above.
[[nodiscard]] double crossing_parameter(const Receiver& receiver, const Corners& s,
                                        const scene::Light& light);

} // namespace gnomon::reference_rt
