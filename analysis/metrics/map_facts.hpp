#pragma once

#include "scene/job/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace gnomon::analysis {

/// What a job's biases are in one cascade.
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
[[nodiscard]] MapFacts facts_of_map(const scene::Job& job, const scene::View& view,
                                    std::size_t map);

} // namespace gnomon::analysis
