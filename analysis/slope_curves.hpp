#pragma once

#include "analysis/bias_limits.hpp"
#include "analysis/critical_bias.hpp"

#include <span>
#include <vector>

namespace gnomon::analysis {

/// How much a lookup's depth differs across its footprint, per unit of tan θ: the natural unit of a
/// slope bias.
///
///     footprint · texel width(ζ) · depth per metre(ζ)        footprint: the filter's width in
///     texels
///
/// @param zeta_m  Light distance [m]; matters for a spot, whose texels grow and whose depth
/// flattens. Source: docs/bias_curve.md#slope.
[[nodiscard]] double depth_per_footprint(const scene::LightFrustum& frustum, int resolution_texels,
                                         scene::Filter filter, double zeta_m);

/// Slope factors worth a curve: 0, ¼, ½, 1, 2 and 4 times `per_footprint`.
///
/// A plane sampled at texel centres needs ½ when the grid lies along its steepest direction and
/// 1/√2 when it lies across (docs/formulas.md#minimum-bias); below are a plane's lucky positions,
/// above is slack for curved surfaces, whose tangent at P says too little about the texel's centre.
/// @param per_footprint  > 0, from `depth_per_footprint`.
/// @throws std::invalid_argument  if it is not positive, or a factor is not a normal float32.
[[nodiscard]] std::vector<float> default_slopes(double per_footprint);

/// Everything about one slope.
struct SlopeCurve {
    float slope = 0;
    BiasCurve curve;
    BestBiases best;
    BiasBounds bounds;
};

/// What slope curves are made of; all images of one size, which the caller keeps alive.
struct SlopeInputs {
    const scene::LookupLayers& samples; ///< from `deciding_samples`: no bias enters them
    LookupRule rule;                    ///< its slope is not read
    const scene::Image<scene::PixelClass>& classes;
    const scene::Image<std::uint8_t>& acne_if_shadowed; ///< the same for every slope
    ForgiveGaps forgive;                                ///< may be empty
};

/// A curve for each slope factor, in the order given.
/// @param slopes  Depth units per unit of tan θ; finite.
/// @throws std::invalid_argument  as `BiasCurve` and `find_bias_bounds` do.
[[nodiscard]] std::vector<SlopeCurve> slope_curves(const SlopeInputs& inputs,
                                                   std::span<const float> slopes);

/// The slope factor whose best constant biases have the fewest errors; of several the one with the
/// widest interval, of those the first. The best pair is its slope and `best.interval.middle()`.
/// @throws std::invalid_argument  if there is no curve.
[[nodiscard]] const SlopeCurve& best_slope(std::span<const SlopeCurve> curves);

} // namespace gnomon::analysis
