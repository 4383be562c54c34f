#pragma once

#include "analysis/limits/bias_limits.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "methods/lookup_traits.hpp"

#include <functional>
#include <vector>

namespace gnomon::analysis {

/// How much a lookup's depth differs across its footprint, per unit of tan θ: the natural unit of a
/// slope bias.
///
///     footprint · texel width(ζ) · depth per metre(ζ)        footprint: its width in texels
///
/// @param light_distance_m  Light distance [m]; matters for a spot, whose texels grow and whose
/// depth flattens. Source: docs/bias_curve.md#slope.
[[nodiscard]] double depth_per_footprint(const scene::LightFrustum& frustum, int resolution_texels,
                                         int footprint_texels, double light_distance_m);

/// The width of a lookup's footprint at this light distance [texels]: of a radius in metres another
/// at each.
[[nodiscard]] int footprint_width_texels(const methods::LookupTraits& traits,
                                         const scene::LightFrustum& frustum, int resolution_texels,
                                         double light_distance_m);

/// Slope factors worth a curve: 0, ¼, ½, 1, 2 and 4 times `per_footprint`, with three digits, as
/// people paste them.
///
/// A plane sampled at texel centres needs ½ when the grid lies along its steepest direction and
/// 1/√2 when it lies across (docs/formulas.md#minimum-bias). Smaller factors serve a plane in some
/// positions only; larger ones leave slack for curved surfaces, whose tangent at P says too little
/// about the texel's centre.
/// @param per_footprint  > 0, from `depth_per_footprint`.
/// @return  Ascending; depth units per unit of tan θ.
/// @throws std::invalid_argument  if it is not positive, or a factor is not a normal float32.
[[nodiscard]] std::vector<float> default_slopes(double per_footprint);
/// Which of them is `per_footprint` itself.
inline constexpr std::size_t slope_of_footprint = 3;

/// Every constant bias at once, with one slope.
struct SlopeCurve {
    float slope = 0;
    scene::Image<float> critical_bias; ///< of each pixel; 0 where there is no receiver
    BiasCurve curve;
    BestBiases best;
    BiasBounds bounds;
};

/// What slope curves are made of; all images of one size, which the caller keeps alive.
struct SlopeInputs {
    const scene::LookupLayers& samples; ///< from `deciding_samples`: no bias enters them
    LookupRule rule;                    ///< its slope is not read
    const scene::Image<scene::PixelClass>& classes;
    const PixelCauses& causes; ///< the same for every slope
    ForgiveGaps forgive;       ///< may be empty
    /// The lookup with its texels and the map, where several texels are read; else nullptr.
    const scene::LookupLayers* lookup = nullptr;
    const scene::Image<float>* map_depths = nullptr;
    /// Of a slope, where no formula has them; else empty.
    std::function<scene::Image<float>(float slope)> find_critical_biases = {};
};

/// The curve of one slope factor.
/// @param slope  Depth units per unit of tan θ; finite.
/// @throws std::invalid_argument  as `BiasCurve` and `find_bias_bounds` do.
[[nodiscard]] SlopeCurve slope_curve(const SlopeInputs& inputs, float slope);

} // namespace gnomon::analysis
