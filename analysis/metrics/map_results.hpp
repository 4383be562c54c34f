#pragma once

#include "analysis/limits/bias_rows.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "scene/pixels/map_texels.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// A job's biases in one of its maps, at some light distance.
struct MapBias {
    double constant = 0;        ///< depth units of this map
    double constant_m = 0;      ///< along the light's axis
    double constant_texels = 0; ///< those metres in texel widths
    double slope_m = 0;         ///< of the slope bias, per unit of tan θ
    double normal_offset_m = 0; ///< displacement of the lookup
};

/// Properties of one of a light's maps.
struct MapFacts {
    std::string name; ///< `scene::View::map_name`
    double near_m = 0;
    double far_m = 0;
    double texel_m = 0;            ///< width of a texel, the larger side; perspective: at ζ = 1
    std::optional<double> begin_m; ///< cascades only: the view depths that bound its slice
    std::optional<double> end_m;
    std::optional<MapBias> bias; ///< cascades only
};

/// @param map               Index among the view's maps.
/// @param light_distance_m  Of the receiver [m]; > 0. Matters only for a spot.
[[nodiscard]] MapBias bias_in_map(const scene::Job& job, const scene::View& view, std::size_t map,
                                  double light_distance_m);

/// @param map  Index among the view's maps.
[[nodiscard]] MapFacts facts_of_map(const scene::Job& job, const scene::View& view,
                                    std::size_t map);

/// Properties and errors of one of a light's several maps.
struct MapResult {
    MapFacts facts;
    MapErrors errors;
};

/// @param errors  By map; empty for a light with one map.
/// @param view    With the constant bias that the errors belong to.
[[nodiscard]] std::vector<MapResult> results_of_maps(const scene::Job& job, const scene::View& view,
                                                     const std::vector<MapErrors>& errors);

/// Errors by map at each of several biases. They equal those that `errors_by_map` finds in GL's own
/// runs at these biases.
/// @param maps       The map that each pixel reads; empty if the light has one map.
/// @param map_count  Of the light.
/// @param biases     Ascending, 0 or normal.
/// @return  By bias, then by map; for a light with one map, an empty list for each bias.
/// @throws std::invalid_argument  as `count_rows`.
[[nodiscard]] std::vector<std::vector<MapErrors>> count_map_errors(const scene::MapIndices& maps,
                                                                   std::size_t map_count,
                                                                   const BiasRowInputs& inputs,
                                                                   std::span<const float> biases);

} // namespace gnomon::analysis
