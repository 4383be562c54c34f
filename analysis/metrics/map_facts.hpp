#pragma once

#include "analysis/metrics/breakdown.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What a job's biases are in one of its maps, at some light distance.
struct MapBias {
    double constant = 0;        ///< depth units of this map
    double constant_m = 0;      ///< along the light's axis
    double constant_texels = 0; ///< those metres over the width of a texel
    double slope_m = 0;         ///< of the slope bias, per unit of tan θ
    double normal_offset_m = 0; ///< that the lookup is moved by
};

/// What one of a light's maps sees.
struct MapFacts {
    std::string name; ///< `scene::View::map_name`
    double near_m = 0;
    double far_m = 0;
    double texel_m = 0; ///< width of a texel, the larger of its sides; perspective: at ζ = 1
    std::optional<double> begin_m; ///< of cascades the view depths between which its slice lies
    std::optional<double> end_m;
    std::optional<MapBias> bias; ///< of cascades
};

/// @param map  index among the view's maps.
/// @param light_distance_m  of the receiver [m]; > 0. It matters to a spot alone.
[[nodiscard]] MapBias bias_in_map(const scene::Job& job, const scene::View& view, std::size_t map,
                                  double light_distance_m);

/// @param map  index among the view's maps.
[[nodiscard]] MapFacts facts_of_map(const scene::Job& job, const scene::View& view,
                                    std::size_t map);

/// What was measured of the pixels that read one of a light's several maps.
struct MapResult {
    MapFacts facts;
    MapErrors errors;
};

/// @param errors  By map; none of a light with one map.
/// @param view    with the constant bias that the errors belong to.
[[nodiscard]] std::vector<MapResult> results_of_maps(const scene::Job& job, const scene::View& view,
                                                     const std::vector<MapErrors>& errors);

} // namespace gnomon::analysis
