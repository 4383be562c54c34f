#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"

#include <optional>

namespace gnomon::analysis {

/// A tolerance in metres that is the same at every distance, and how far it covers what storing a
/// depth does to it.
struct ConstantTolerance {
    double tolerance_m = 0;
    /// The distance from which the sawtooth's envelope exceeds it first; near where it does at
    /// once, empty where it never does.
    std::optional<double> exceeded_from_m;
};

/// With AΔζ²/(1 − AΔζ) = T, ζ = 2T/(AΔT + √((AΔT)² + 4AΔT)) between two borders of Δ; an
/// orthographic projection's envelope is constant there.
/// @param tolerance_m  T, above 0.
/// Source: docs/depth_precision.md#constant-tolerance.
[[nodiscard]] ConstantTolerance constant_tolerance(const DepthMapping& mapping,
                                                   const DepthCoding& coding, double tolerance_m);

} // namespace gnomon::analysis
