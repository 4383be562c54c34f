#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/pixels/statistics.hpp"

#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The errors of the scored pixels between two view depths, and the width of the texels that they
/// read.
struct ViewDepthErrors {
    double lower_m = 0;
    double upper_m = 0; ///< excluded, except in the last band
    SubsetCounts counts;
    /// Width of a texel at the pixels, in the map that each reads [m]; empty without pixels.
    std::optional<Quantiles> texel_m;
};

/// Errors by view depth [m], the distance from the eye along the camera's axis,
///
///     forward · (P − eye)
///
/// in the bands of `bin_by_view_depth`, which are equal for every map of a camera and a light.
/// @param comparison  Its light has a map.
/// @throws std::invalid_argument  if `bands` is not in [1, 254].
[[nodiscard]] std::vector<ViewDepthErrors> errors_by_view_depth(const Comparison& comparison,
                                                                int bands);

} // namespace gnomon::analysis
