#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// What a depth becomes by being stored, computed without any other error.
///
/// An evenly spaced code stores the nearest of its depths. A float32 stores fl(d) with the clip
/// range [0, 1], but fl(½·fl(2d − 1) + ½) with [−1, 1], as z_ndc is a float32 as well; of the same
/// float32 a float16 and packed bytes are made.
struct StoredDepth {
    std::uint32_t code = 0;
    double depth = 0;
    double light_distance_m = 0; ///< the distance that the code stands for
    double error_m = 0;          ///< light_distance_m less the true distance: the sawtooth
};

/// @param light_distance_m  [near, far]
/// Source: docs/depth_precision.md#sawtooth.
[[nodiscard]] StoredDepth stored_depth(const DepthMapping& mapping, const DepthCoding& coding,
                                       double light_distance_m);

/// Bound Δ on |stored − exact| depth at a distance: the coding's half step; for floats, with the
/// clip range [−1, 1], half of z_ndc's on top.
[[nodiscard]] double depth_tolerance(const DepthMapping& mapping, const DepthCoding& coding,
                                     double light_distance_m);

/// The envelope of the sawtooth, which it never leaves [m]:
///
///     E(ζ) = AΔζ²/(1 − AΔζ), Δ = depth_tolerance;   orthographic: Δ(f − n)
///
/// Doubling Δ (`codes` = 2) allows either of the two nearest codes, as GL does, or truncation.
/// Source: docs/depth_precision.md#envelope.
[[nodiscard]] double error_envelope_m(const DepthMapping& mapping, const DepthCoding& coding,
                                      double light_distance_m, double codes = 1);

/// Where between near and far the envelope, and with it the step between codes, is largest.
struct CoarsestDepth {
    double light_distance_m = 0;
    double tolerance = 0; ///< Δ there
};

/// Δ is constant between its borders and ζ² grows, so it is at one of them or at an end: of evenly
/// spaced codes far.
[[nodiscard]] CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding);
/// The same between two distances.
/// @param from_m, to_m  [near, far], in their order or equal
[[nodiscard]] CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding,
                                           double from_m, double to_m);

/// The distances between which Δ is constant, ascending from near to far [m]: these two alone for
/// evenly spaced codes; for floats also those where d or |z_ndc| is a power of two, packed those
/// where the first byte changes.
[[nodiscard]] std::vector<double> tolerance_borders_m(const DepthMapping& mapping,
                                                      const DepthCoding& coding);

/// The largest error between near and far [m].
///
/// Evenly spaced codes: attained half a code before far, A(q/2)f²/(1 + A(q/2)f); orthographic
/// (q/2)(f − n). Others: the envelope's largest value.
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

} // namespace gnomon::analysis
