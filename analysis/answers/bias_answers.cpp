#include "analysis/answers/bias_answers.hpp"
#include "methods/depth/filters.hpp"

#include <cmath>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The slope factors to answer for: the usual ones for the size of the map's texels, a spot's at
/// the geometric mean of near and far.
std::vector<float> slopes(const BiasQuestion& question)
{
    const scene::LightFrustum& frustum = question.view.frustum;
    const double light_distance_m = std::sqrt(std::abs(frustum.near_m * frustum.far_m));
    return default_slopes(depth_per_footprint(frustum, question.job.shadow_map.resolution_texels,
                                              question.job.lookup.filter, light_distance_m));
}

/// Nothing where even the slope's best bias leaves no less than `own` does: it is no remedy then.
std::optional<Recommendation> recommended(const BiasQuestion& question, const SlopeCurve& curve,
                                          const std::optional<Recommendation>& own)
{
    const bool can_leave_less =
        own && static_cast<double>(curve.best.errors.total()) < own->pasted_outcome.error_amount();
    if (!can_leave_less || methods::filter_promises(question.job.lookup.filter).has_fractions()) {
        return std::nullopt;
    }
    return recommend_by_count(curve.curve,
                              {question.view.frustum, question.job.shadow_map.resolution_texels,
                               question.unit_light_distance_m},
                              question.job.bias);
}

void answer_slopes(const BiasQuestion& question, const std::optional<Recommendation>& own,
                   BiasAnswers& answers)
{
    for (const float slope : slopes(question)) {
        const SlopeCurve curve = slope_curve(question.curves, slope);
        if (answers.slopes.empty() ||
            is_better(curve.best, answers.slopes[answers.best_slope].best)) {
            answers.best_slope = answers.slopes.size();
        }
        answers.slopes.push_back(
            {slope, curve.best, curve.bounds, recommended(question, curve, own)});
    }
}

} // namespace

BiasAnswers answer_biases(const BiasQuestion& question, SlopeCurve own,
                          const std::optional<Recommendation>& recommended)
{
    BiasMap map = map_biases({own.critical_bias, question.curves.classes, question.curves.samples,
                              question.light_distance_m, question.view.frustum,
                              question.job.shadow_map.resolution_texels,
                              question.job.shadow_map.depth_format});
    BiasAnswers answers{std::move(own.critical_bias),
                        std::move(own.curve),
                        own.best,
                        own.bounds,
                        std::move(map),
                        {},
                        0};
    answer_slopes(question, recommended, answers);
    return answers;
}

} // namespace gnomon::analysis
