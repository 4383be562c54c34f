#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "reference_rt/pixels/corner_fans.hpp"
#include "scene/geometry/triangles.hpp"

#include <cstdint>

namespace gnomon::reference_rt {

/// Decides whether the surface continues from a receiver to the triangle seen at a texel
/// (docs/truth.md).
///
/// In light view, projected along the texel rays, p is P and c the texel's centre. A walk starts in
/// T and crosses an edge (a, b) of a triangle
///
///   * to triangles that share the edge from its other side, as elsewhere the surface folds over or
///     ends;
///   * if the segment pc leaves the triangle there, runs along the edge, or passes through one of
///     its ends; the walk may go either way around a vertex.
///
/// The sides of a and b of the line pc, and of p, c and the apex of ab, decide.
class SelfShadowingSurface {
public:
    /// All arguments must outlive this object.
    SelfShadowingSurface(const scene::TriangleScene& triangles, const CornerFans& fans,
                         const TexelRays& rays)
        : triangles_{triangles},
          fans_{fans},
          rays_{rays}
    {
    }

    /// Whether a walk from the receiver towards the texel's centre enters the triangle.
    [[nodiscard]] bool leads(const Receiver& receiver, scene::Texel texel,
                             std::uint32_t triangle) const;

private:
    const scene::TriangleScene& triangles_;
    const CornerFans& fans_;
    const TexelRays& rays_;
};

} // namespace gnomon::reference_rt
