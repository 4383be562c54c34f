#include "analysis/diagnosis/bias_answers.hpp"

#include "analysis/pixels/maps_of_pixels.hpp"
#include "methods/job_method.hpp"

#include <cmath>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The slope factors to evaluate: the default ones for the texel size; for a spot, at the geometric
/// mean of near and far.
std::vector<float> slopes(const BiasQuestion& question)
{
    const scene::LightFrustum& frustum = question.view.first_map();
    const double light_distance_m = std::sqrt(std::abs(frustum.near_m * frustum.far_m));
    const int resolution = question.job.shadow_map.resolution_texels;
    const int width = footprint_width_texels(methods::traits(question.job), frustum, resolution,
                                             light_distance_m);
    return default_slopes(depth_per_footprint(frustum, resolution, width, light_distance_m));
}

/// Empty if even the slope's best bias leaves more errors than `own`.
std::optional<Recommendation> recommended_with(const BiasQuestion& question,
                                               const SlopeCurve& curve,
                                               const std::optional<Recommendation>& own)
{
    const bool can_be_as_good = own && static_cast<double>(curve.best.errors.total()) <=
                                           own->rounded_outcome.error_amount();
    if (!can_be_as_good || methods::traits(question.job).has_fractions()) {
        return std::nullopt;
    }
    const std::size_t map = most_read_map(question.curves.samples.maps, question.curves.classes);
    return recommend_by_count(curve.curve,
                              bias_lengths_in(question.view,
                                              question.job.shadow_map.resolution_texels,
                                              question.unit_light_distance_m, map),
                              question.job.bias);
}

struct SlopeAnswers {
    std::vector<SlopeAnswer> all;
    std::size_t best = 0; ///< index into `slopes`
};

/// @param own          The curve of the job's own slope, which is reused.
/// @param recommended  The recommendation from that curve.
SlopeAnswers answer_slopes(const BiasQuestion& question, const SlopeCurve& own,
                           const std::optional<Recommendation>& recommended)
{
    SlopeAnswers answers;
    for (const float slope : slopes(question)) {
        const std::optional<SlopeCurve> other =
            slope == own.slope ? std::nullopt : std::optional{slope_curve(question.curves, slope)};
        const SlopeCurve& curve = other ? *other : own;
        if (answers.all.empty() || is_better(curve.best, answers.all[answers.best].best)) {
            answers.best = answers.all.size();
        }
        answers.all.push_back(
            {slope, curve.best, curve.bounds, recommended_with(question, curve, recommended)});
    }
    return answers;
}

} // namespace

BiasAnswers answer_biases(const BiasQuestion& question, SlopeCurve own,
                          const std::optional<Recommendation>& recommended)
{
    SlopeAnswers by_slope = answer_slopes(question, own, recommended);
    BiasMap map = map_biases({own.critical_bias,
                              question.curves.classes,
                              question.curves.samples,
                              question.light_distance_m,
                              {question.view.maps, question.curves.samples.maps,
                               question.job.shadow_map.resolution_texels},
                              question.job.shadow_map.depth_format,
                              question.view.bias_scales});
    return {
        std::move(own.critical_bias), std::move(own.curve), own.best, own.bounds, std::move(map),
        std::move(by_slope.all),      by_slope.best};
}

} // namespace gnomon::analysis
