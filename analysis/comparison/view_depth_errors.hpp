#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/pixels/quantiles.hpp"

#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The scored pixels between two view depths: how many of them are wrong, and how wide the texels
/// are that they read.
struct ViewDepthErrors {
    double lower_m = 0;
    double upper_m = 0; ///< excluded, except in the last band
    SubsetCounts counts;
    /// Width of a texel where the pixels are, in the map that each reads [m]; empty: no pixels.
    std::optional<Quantiles> texel_m;
};

/// By view depth [m], which is the distance from the eye along the camera's axis,
///
///     forward · (P − eye)
///
/// in bands as `bin_by_view_depth` has them: the same for every map of a camera and a light.
/// @param comparison  whose light has a map.
/// @throws std::invalid_argument  if `bands` is not in [1, 254].
[[nodiscard]] std::vector<ViewDepthErrors> errors_by_view_depth(const Comparison& comparison,
                                                                int bands);

} // namespace gnomon::analysis
