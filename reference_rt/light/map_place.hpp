#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/texel_rays.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/frustum.hpp"
#include "scene/vec.hpp"

namespace gnomon::reference_rt {

/// Where a point exactly is on a map, rounded down to float32: below the same texel centres and
/// borders as
///
///     uv · n = n (X·P′ + W·P′) / (2 W·P′),   v with Y in place of X
///
/// with X, Y and W rows of the float32 `light_clip_from_world`, P′ = P + offset.
/// @return  NaN in the light's camera plane. Results that would be subnormal are 0, or, below 0,
/// the
///          normal number nearest to it.
[[nodiscard]] scene::Vec2f map_place(const ClipRows& rows, const Receiver& hit,
                                     const scene::Vec3d& offset, int resolution_texels);

/// 256 roundings of the largest terms that a float32 transform of a point of the box has, as a
/// length on the map [texels]: far more than its handful of roundings amounts to.
[[nodiscard]] double place_error_texels(const scene::LightFrustum& map, const scene::Box& box,
                                        int resolution_texels);

} // namespace gnomon::reference_rt
