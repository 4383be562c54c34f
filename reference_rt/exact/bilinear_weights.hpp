#pragma once

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/exact/wide.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"

#include <array>

namespace gnomon::reference_rt {

/// What four texels count for at a receiver, row by row from the lower left one:
///
///     (1 − x)(1 − y), x(1 − y), (1 − x)y, xy,   x = uv·n − ½ less the lower left texel's, in [0,
///     1]
///
/// uv is where P, or the point that is moved from it, exactly is on the map: ½(X·P)/(W·P) + ½ and Y
/// alike, with X, Y and W rows of the float32 `light_clip_from_world`.
class BilinearWeights {
public:
    /// All arguments must outlive it. Precondition: the hit's δ is not 0.
    /// @param offset  of the point from P.
    BilinearWeights(const ClipRows& rows, const Receiver& hit, const scene::Vec3d& offset,
                    scene::Texel first, int resolution_texels)
        : rows_{rows},
          hit_{hit},
          offset_{offset},
          first_{first},
          resolution_{resolution_texels}
    {
    }

    [[nodiscard]] std::array<Interval, 4> bounded() const;
    /// Bounded far more closely, at a cost; with infinite errors where the hit is not well scaled.
    [[nodiscard]] std::array<Wide, 4> sharp() const;
    /// Denominators are 0 where P is in the light's camera plane.
    [[nodiscard]] std::array<Fraction, 4> exact() const;

private:
    /// What W·P counts for in 2 x W·P = n X·P + (n − 1 − 2·texel) W·P.
    [[nodiscard]] double base(int texel) const
    {
        return static_cast<double>(resolution_) - 1 - 2 * static_cast<double>(texel);
    }

    const ClipRows& rows_;
    const Receiver& hit_;
    scene::Vec3d offset_;
    scene::Texel first_;
    int resolution_;
};

} // namespace gnomon::reference_rt
