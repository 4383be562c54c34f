#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "reference_rt/pixels/corner_fans.hpp"
#include "scene/geometry/triangles.hpp"

#include <cstdint>

namespace gnomon::reference_rt {

/// Finds whether the surface leads from a receiver to what a texel sees (docs/truth.md).
///
/// In light view, where everything is projected along the texel rays, p is P and c the texel's
/// centre. A walk that begins in T crosses an edge (a, b) of a triangle
///
///   * to the triangles with the same edge on its other side: else it folds over, or ends;
///   * if the segment from p to c leaves the triangle there, or runs along the edge, or through one
///     of its ends: around a vertex any way counts.
///
/// All of it is decided by the sides of a, b from the line pc, and of p, c and the apex from ab.
class SelfShadowingSurface {
public:
    /// All arguments must outlive it.
    SelfShadowingSurface(const scene::TriangleScene& triangles, const CornerFans& fans,
                         const TexelRays& rays)
        : triangles_{triangles},
          fans_{fans},
          rays_{rays}
    {
    }

    /// True when a walk from the receiver towards the texel's centre enters the triangle.
    [[nodiscard]] bool leads(const Receiver& receiver, scene::Texel texel,
                             std::uint32_t triangle) const;

private:
    const scene::TriangleScene& triangles_;
    const CornerFans& fans_;
    const TexelRays& rays_;
};

} // namespace gnomon::reference_rt
