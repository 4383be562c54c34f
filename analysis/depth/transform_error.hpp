#pragma once

#include "analysis/depth/depth_mapping.hpp"

#include <cstdint>

namespace gnomon::analysis {

/// How a vertex shader takes a vertex from the world to clip space.
enum class TransformOrder : std::uint8_t {
    view_then_projection, ///< two float32 matrices, one after the other
    premultiplied         ///< one float32 matrix, composed beforehand
};

/// First-order bound on the error of the distance that float32 evaluation of a vertex's transform,
/// division and viewport leaves, matrices rounded once, sums in any order [m].
///
///     view, then projection   γ5·S + AΔζ²,  2Δ = γ3(|a| + |b|/ζ) + u|z_ndc| + 2·½ulp(d)
///     premultiplied           AΔζ²,         2Δ = γ5(S_z + |z_ndc|S)/ζ + u|z_ndc| + 2·½ulp(d)
///
/// with z_clip = aζ + b, S_z = |a|S + |b|, γk = ku/(1 − ku), u = 2^-24. With the clip range [0, 1]
/// Δ is not halved and the viewport rounds nothing; an orthographic projection divides by 1.
/// @param row_sum_m  S: sum of the absolute products of the view matrix's z row with the vertex
///                   [m], at least |ζ|; |offset| + |vertex| for an axis-parallel view.
/// Source: docs/depth_precision.md#vertex-transform.
[[nodiscard]] double transform_error_m(const DepthMapping& mapping, TransformOrder order,
                                       double light_distance_m, double row_sum_m);

} // namespace gnomon::analysis
