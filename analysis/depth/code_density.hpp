#pragma once

#include "analysis/depth/depth_coding.hpp"
#include "analysis/depth/depth_mapping.hpp"

#include <optional>

namespace gnomon::analysis {

/// Distance between neighbouring codes at ζ, to first order [m]: twice the tolerance times |dζ/dd|,
/// qAζ² for evenly spaced codes.
/// Source: docs/depth_precision.md#codes-per-metre.
[[nodiscard]] double code_step_m(const DepthMapping& mapping, const DepthCoding& coding,
                                 double light_distance_m);

/// The largest distance between neighbouring codes from near to far [m], to first order: of evenly
/// spaced ones far's.
[[nodiscard]] double largest_code_step_m(const DepthMapping& mapping, const DepthCoding& coding);

/// Codes per metre at ζ [1/m]: 1/step.
[[nodiscard]] double codes_per_metre(const DepthMapping& mapping, const DepthCoding& coding,
                                     double light_distance_m);

/// Share of all codes that stand for distances up to ζ; in [0, 1]; packed: by their depth.
/// @param light_distance_m  clamped to [near, far], distances over far to [0, far].
[[nodiscard]] double code_share_within(const DepthMapping& mapping, const DepthCoding& coding,
                                       double light_distance_m);

/// The distance at which neighbouring evenly spaced codes are this far apart [m]: √(step/(Aq)).
///
/// Empty for other codes and for orthographic projections, whose steps do not grow with ζ²; the
/// result may lie outside [near, far].
[[nodiscard]] std::optional<double> distance_of_step_m(const DepthMapping& mapping,
                                                       const DepthCoding& coding, double step_m);

/// The distance at which float32 stops being finer than evenly spaced codes of `bits` bits; for
/// reversed depth, starts [m]. It is where d = 2^(23 − bits): 2fn/(f + n) for 24 bits and a
/// perspective.
/// @param bits  [24, 32]; with fewer bits float32 is always finer.
/// @throws std::domain_error  if bits are out of range.
/// Source: docs/depth_precision.md#float32.
[[nodiscard]] double float_limit_m(const DepthMapping& mapping, int bits = 24);

} // namespace gnomon::analysis
