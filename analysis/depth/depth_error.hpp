#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// A depth as stored, without any other error.
///
/// Evenly spaced: the nearest code. A float32 stores fl(d) with the clip range [0, 1], but
/// fl(½·fl(2d − 1) + ½) with [−1, 1], as z_ndc is a float32 too. Float16 and packed codes encode
/// that float32.
struct StoredDepth {
    std::uint32_t code = 0;
    double depth = 0;
    double light_distance_m = 0; ///< the distance that the code stands for
    double error_m = 0;          ///< stored minus true distance: the sawtooth
};

/// @param light_distance_m  [near, far]
/// Source: docs/depth_precision.md#sawtooth.
[[nodiscard]] StoredDepth stored_depth(const DepthMapping& mapping, const DepthCoding& coding,
                                       double light_distance_m);

/// Bound Δ on |stored − exact| depth at a distance: the coding's half step, plus half of z_ndc's
/// for floats with the clip range [−1, 1].
[[nodiscard]] double depth_tolerance(const DepthMapping& mapping, const DepthCoding& coding,
                                     double light_distance_m);

/// The envelope of the sawtooth [m]:
///
///     E(ζ) = AΔζ²/(1 − AΔζ), Δ = depth_tolerance;   orthographic: Δ(f − n)
///
/// `codes` = 2 doubles Δ: it allows truncation, and either of the two nearest codes, as GL does.
/// Source: docs/depth_precision.md#envelope.
[[nodiscard]] double error_envelope_m(const DepthMapping& mapping, const DepthCoding& coding,
                                      double light_distance_m, double codes = 1);

/// The distance between near and far with the largest envelope, and so the largest step between
/// codes.
struct CoarsestDepth {
    double light_distance_m = 0;
    double tolerance = 0; ///< Δ there
};

/// Δ is constant between its borders and ζ² grows, so the maximum lies at a border or an end; for
/// evenly spaced codes at far.
[[nodiscard]] CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding);
/// The coarsest distance between two others.
/// @param from_m, to_m  [near, far], in their order or equal
[[nodiscard]] CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding,
                                           double from_m, double to_m);

/// The distances between which Δ is constant, ascending from near to far [m]: only these two for
/// evenly spaced codes; for floats also those where d or |z_ndc| is a power of two; packed, those
/// where the first byte changes.
[[nodiscard]] std::vector<double> tolerance_borders_m(const DepthMapping& mapping,
                                                      const DepthCoding& coding);

/// The largest error between near and far [m].
///
/// Evenly spaced codes reach it half a code before far: A(q/2)f²/(1 + A(q/2)f), or (q/2)(f − n) for
/// an orthographic projection. For others it is the envelope's largest value.
/// Source: docs/depth_precision.md#largest-error.
[[nodiscard]] double largest_error_m(const DepthMapping& mapping, const DepthCoding& coding);

/// The distance ζ_k at which code k is exact, a zero of the sawtooth [m].
[[nodiscard]] double exact_distance_m(const DepthMapping& mapping, const DepthCoding& coding,
                                      std::uint32_t code);

/// The smooth bound on float32 storage with the clip range [0, 1] [m], u = 2^-24:
///
///     perspective   uζ(ζ − n)/n;   reversed  uζ(1 − ζ/f) <= f·2^-26
///     orthographic  u(ζ − n);      reversed  u(f − ζ)
///
/// First order in u. Source: docs/depth_precision.md#float32.
[[nodiscard]] double smooth_float_envelope_m(const DepthMapping& mapping, double light_distance_m);

/// A tolerance in metres that does not vary with distance, and how far it covers the storage error.
struct ConstantTolerance {
    double tolerance_m = 0;
    /// The first distance at which the sawtooth's envelope exceeds it; near if it does everywhere
    /// before, empty if it never does.
    std::optional<double> exceeded_from_m;
};

/// AΔζ²/(1 − AΔζ) = T gives ζ = 2T/(AΔT + √((AΔT)² + 4AΔT)) between two borders of Δ; an
/// orthographic projection's envelope is constant there.
/// @param tolerance_m  T [m], above 0.
/// Source: docs/depth_precision.md#constant-tolerance.
[[nodiscard]] ConstantTolerance constant_tolerance(const DepthMapping& mapping,
                                                   const DepthCoding& coding, double tolerance_m);

/// Distance between neighbouring codes at ζ, to first order [m]: twice the tolerance times |dζ/dd|;
/// qAζ² for evenly spaced codes.
/// Source: docs/depth_precision.md#codes-per-metre.
[[nodiscard]] double code_step_m(const DepthMapping& mapping, const DepthCoding& coding,
                                 double light_distance_m);

/// The largest distance between neighbouring codes from near to far, to first order [m]; evenly
/// spaced codes have it at far.
[[nodiscard]] double largest_code_step_m(const DepthMapping& mapping, const DepthCoding& coding);

/// Codes per metre at ζ [1/m]: 1/step.
[[nodiscard]] double codes_per_metre(const DepthMapping& mapping, const DepthCoding& coding,
                                     double light_distance_m);

/// Share of all codes that stand for distances up to ζ; in [0, 1]. Packed codes count by their
/// depth.
/// @param light_distance_m  Clamped to [near, far]; distances over far to [0, far].
[[nodiscard]] double code_share_within(const DepthMapping& mapping, const DepthCoding& coding,
                                       double light_distance_m);

/// The distance at which neighbouring evenly spaced codes are `step_m` apart [m]: √(step/(Aq)).
///
/// Empty for other codes, and for orthographic projections, whose steps are constant. The result
/// may lie outside [near, far].
[[nodiscard]] std::optional<double> distance_of_step_m(const DepthMapping& mapping,
                                                       const DepthCoding& coding, double step_m);

/// The distance at which float32 stops being finer than evenly spaced codes, or starts if depth is
/// reversed [m]: where d = 2^(23 − bits), which is 2fn/(f + n) for 24 bits and a perspective.
/// @param bits  [24, 32]; float32 is always finer than fewer bits.
/// @throws std::domain_error  if bits are out of range.
/// Source: docs/depth_precision.md#float32.
[[nodiscard]] double float_limit_m(const DepthMapping& mapping, int bits = 24);

/// How a vertex shader takes a vertex from the world to clip space.
enum class TransformOrder : std::uint8_t {
    view_then_projection, ///< two float32 matrices, one after the other
    premultiplied         ///< one float32 matrix, composed beforehand
};

/// First-order bound on the distance error [m] of float32 evaluation of a vertex's transform,
/// division and viewport, with matrices rounded once and sums in any order.
///
///     view, then projection   γ5·S + AΔζ²,  2Δ = γ3(|a| + |b|/ζ) + u|z_ndc| + 2·½ulp(d)
///     premultiplied           AΔζ²,         2Δ = γ5(S_z + |z_ndc|S)/ζ + u|z_ndc| + 2·½ulp(d)
///
/// with z_clip = aζ + b, S_z = |a|S + |b|, γk = ku/(1 − ku), u = 2^-24. The clip range [0, 1] does
/// not halve Δ, and its viewport rounds nothing; an orthographic projection divides by 1.
/// @param row_sum_m  S: sum of the absolute products of the view matrix's z row with the vertex
///                   [m], at least |ζ|; |offset| + |vertex| for an axis-parallel view.
/// Source: docs/depth_precision.md#vertex-transform.
[[nodiscard]] double transform_error_m(const DepthMapping& mapping, TransformOrder order,
                                       double light_distance_m, double row_sum_m);

} // namespace gnomon::analysis
