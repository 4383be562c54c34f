#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/bias/bias_units.hpp"
#include "analysis/causes/pixel_causes.hpp"
#include "analysis/limits/bias_limits.hpp"
#include "analysis/limits/slope_curves.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The best constant bias at another slope factor.
struct SlopeAnswer {
    float slope = 0; ///< depth units per unit of tan θ
    BestBiases best;
    BiasBounds bounds;
    /// Only if amounts equal counts (otherwise each slope would have to be measured), and if some
    /// bias leaves no more errors than the recommendation at the job's own slope.
    std::optional<Recommendation> recommended;
};

/// Results for every constant bias, with the job's slope and normal offset.
struct BiasAnswers {
    scene::Image<float> critical_bias; ///< of each pixel; 0 where there is no receiver
    BiasCurve curve;
    BestBiases best;
    BiasBounds bounds;
    BiasMap map;                     ///< the bias that each pixel needs or allows
    std::vector<SlopeAnswer> slopes; ///< for other slope factors
    std::size_t best_slope = 0;      ///< index into `slopes`; with its best bias the best pair
};

/// Inputs of the bias answers; all images have one size.
struct BiasQuestion {
    const scene::Job& job;
    const scene::View& view;
    SlopeInputs curves;
    const scene::Image<float>& light_distance_m; ///< light distance of the receivers [m]
    double unit_light_distance_m = 0;            ///< where biases are converted to lengths [m]
};

/// Finds the results for all constant biases at the job's own slope, and the best for other slopes.
/// @param own          The curve of the job's own slope.
/// @param recommended  The recommendation from that curve.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] BiasAnswers answer_biases(const BiasQuestion& question, SlopeCurve own,
                                        const std::optional<Recommendation>& recommended);

} // namespace gnomon::analysis
