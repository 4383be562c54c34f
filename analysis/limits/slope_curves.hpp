#pragma once

#include "analysis/limits/bias_limits.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "methods/lookup_traits.hpp"

#include <functional>
#include <vector>

namespace gnomon::analysis {

/// How much depth changes across a lookup's footprint per unit of tan θ: the natural unit of a
/// slope bias.
///
///     footprint · texel width(ζ) · depth per metre(ζ)        footprint: its width in texels
///
/// @param light_distance_m  Light distance [m]; matters only for a spot, whose texels grow and
///                          whose depth flattens with distance.
/// Source: docs/bias_curve.md#slope.
[[nodiscard]] double depth_per_footprint(const scene::LightFrustum& frustum, int resolution_texels,
                                         int footprint_texels, double light_distance_m);

/// Width of a lookup's footprint at this light distance [texels]. It varies if the radius is in
/// metres.
[[nodiscard]] int footprint_width_texels(const methods::LookupTraits& traits,
                                         const scene::LightFrustum& frustum, int resolution_texels,
                                         double light_distance_m);

/// The slope factors to examine: 0, ¼, ½, 1, 2 and 4 times `per_footprint`, rounded to three
/// digits.
///
/// A plane sampled at texel centres needs ½ if the grid lies along its steepest direction, and 1/√2
/// if it lies across (docs/formulas.md#minimum-bias). Smaller factors serve a plane only in some
/// positions. Larger ones leave slack for curved surfaces, whose tangent at P says little about the
/// texel's centre.
/// @param per_footprint  > 0, from `depth_per_footprint`.
/// @return  Ascending; depth units per unit of tan θ.
/// @throws std::invalid_argument  if `per_footprint` is not positive, or if a factor is not a
///                                normal float32.
[[nodiscard]] std::vector<float> default_slopes(double per_footprint);
/// Index of `per_footprint` itself among the default slopes.
inline constexpr std::size_t slope_of_footprint = 3;

/// Every constant bias at one slope.
struct SlopeCurve {
    float slope = 0;
    scene::Image<float> critical_bias; ///< of each pixel; 0 where there is no receiver
    BiasCurve curve;
    BestBiases best;
    BiasBounds bounds;
};

/// Inputs of slope curves; all images have one size and must stay alive.
struct SlopeInputs {
    const scene::LookupLayers& samples; ///< from `deciding_samples`; independent of bias
    LookupRule rule;                    ///< its slope is ignored
    const scene::Image<scene::PixelClass>& classes;
    const PixelCauses& causes; ///< equal for every slope
    ForgiveGaps forgive;       ///< may be empty
    /// The lookup with its texels, and the map, if several texels are read; else null.
    const scene::LookupLayers* lookup = nullptr;
    const scene::Image<float>* map_depths = nullptr;
    /// Finds the critical biases at a slope if no formula gives them; else empty.
    std::function<scene::Image<float>(float slope)> find_critical_biases = {};
};

/// The bias curve at one slope factor.
/// @param slope  Depth units per unit of tan θ; finite.
/// @throws std::invalid_argument  as `BiasCurve` and `find_bias_bounds`.
[[nodiscard]] SlopeCurve slope_curve(const SlopeInputs& inputs, float slope);

} // namespace gnomon::analysis
