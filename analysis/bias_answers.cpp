#include "analysis/bias_answers.hpp"

#include "analysis/critical_bias.hpp"
#include "analysis/pixel_runs.hpp"
#include "analysis/slope_curves.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

/// The slope factors to answer for: the usual ones for the size of the map's texels, a spot's at
/// the geometric mean of near and far.
std::vector<float> slopes(const BiasQuestion& question)
{
    const scene::LightFrustum& frustum = question.view.frustum;
    const double zeta_m = std::sqrt(std::abs(frustum.near_m * frustum.far_m));
    return default_slopes(depth_per_footprint(frustum, question.job.shadow_map.resolution_texels,
                                              question.job.lookup.filter, zeta_m));
}

void answer_slopes(const SlopeInputs& inputs, const BiasQuestion& question, BiasAnswers& answers)
{
    for (const float slope : slopes(question)) {
        const float one[]{slope};
        const SlopeCurve curve = std::move(slope_curves(inputs, one).front());
        if (answers.slopes.empty() ||
            is_better(curve.best, answers.slopes[answers.best_slope].best)) {
            answers.best_slope = answers.slopes.size();
        }
        answers.slopes.push_back({slope, curve.best, curve.bounds});
    }
}

} // namespace

scene::Image<std::uint8_t> acne_flags(const scene::Image<scene::PixelClass>& classes,
                                      const scene::Image<PixelCause>& pixels)
{
    scene::Image<std::uint8_t> flags{classes.size()};
    for_each_run(flags.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            flags[i] = is_acne_if_shadowed(pixels[i], classes[i]) ? 1 : 0;
        }
    });
    return flags;
}

BiasAnswers answer_biases(const BiasQuestion& question)
{
    const LookupRule rule = lookup_rule(question.job, question.view);
    const auto& classes = question.truth.pixel_class;
    const scene::LookupLayers& samples = question.deciding;
    const auto acne = acne_flags(classes, question.pixels);
    auto critical = critical_biases(samples, rule);
    BiasCurve curve{critical, classes};
    const BestBiases best = find_best_biases(curve);
    const BiasBounds bounds = find_bias_bounds(curve, critical, classes, acne, question.forgive);
    BiasMap map = map_biases({critical, classes, samples, question.zeta_m, question.view.frustum,
                              question.job.shadow_map.resolution_texels,
                              question.job.shadow_map.depth_format});
    BiasAnswers answers{std::move(critical), std::move(curve), best, bounds, std::move(map), {}, 0};
    answer_slopes({samples, rule, classes, acne, question.forgive}, question, answers);
    return answers;
}

} // namespace gnomon::analysis
