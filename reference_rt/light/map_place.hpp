#pragma once

#include "reference_rt/exact/interval.hpp"
#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "renderers/light_queries.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

#include <array>

namespace gnomon::reference_rt {

/// The exact position of a point on a map, rounded down to float32, which keeps its order with
/// texel centres and borders:
///
///     uv · n = n (X·P′ + W·P′) / (2 W·P′),   v with Y in place of X
///
/// with X, Y and W rows of the float32 `light_clip_from_world`, P′ = P + offset.
/// @return  NaN in the light's camera plane. Subnormal results become 0, or the normal number
///          nearest to 0 if negative.
[[nodiscard]] scene::Vec2f map_place(const ClipRows& rows, const Receiver& hit,
                                     const scene::Vec3d& offset, int resolution_texels);

/// A generous error bound of a float32 transform of any point in the box, as a length on the map
/// [texels]: 256 roundings of its largest terms.
[[nodiscard]] double place_error_texels(const scene::LightFrustum& map, const scene::Box& box,
                                        int resolution_texels);

/// The bilinear weights of four texels at a receiver, row by row from the lower left:
///
///     (1 − x)(1 − y), x(1 − y), (1 − x)y, xy,   x = uv·n − ½ less the lower left texel's, in [0,
///     1]
///
/// uv is the exact map position of P, or of its moved point: ½(X·P)/(W·P) + ½, v with Y, for rows
/// X, Y and W of the float32 `light_clip_from_world`.
class BilinearWeights {
public:
    /// All arguments must outlive this object. Precondition: the hit's δ is not 0.
    /// @param offset  from P to the point.
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
    /// Far tighter bounds, at a cost; errors are infinite if the hit is not well scaled.
    [[nodiscard]] std::array<DoubleDouble, 4> sharp() const;
    /// Denominators are 0 if P is in the light's camera plane.
    [[nodiscard]] std::array<Fraction, 4> exact() const;

private:
    /// The factor of W·P in 2 x W·P = n X·P + (n − 1 − 2·texel) W·P.
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
