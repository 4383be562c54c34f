#include "analysis/answers/finished_curve.hpp"

#include "analysis/bias_rows.hpp"
#include "analysis/depth/bin_envelopes.hpp"
#include "analysis/error_parts.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/tune.hpp"

#include <array>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

CurveResult describe_map(std::string id, const scene::Job& job, const scene::View& view)
{
    CurveResult result;
    result.id = std::move(id);
    result.near_m = view.frustum.near_m;
    result.far_m = view.frustum.far_m;
    result.map_bytes = map_bytes(job.shadow_map);
    return result;
}

} // namespace

CurveResult describe_curve(std::string id, const DescribedCurve& described)
{
    using At = DistanceProfile::At;
    CurveResult result = describe_map(std::move(id), described.job, described.view);
    result.best = described.best;
    result.bounds = described.bounds;
    result.points = sample_curve(described.curve);
    const std::array<float, 2> biases{described.job_bias, described.best.recommended()};
    auto profiles = errors_by_bin(described.distances, described.inputs, biases);
    for (std::vector<ErrorBin>& profile : profiles) {
        add_envelopes(profile, described.view.frustum, described.job.shadow_map.depth_format);
    }
    result.by_distance = {{At::job_bias, biases[0], std::move(profiles[0])},
                          {At::best_bias, biases[1], std::move(profiles[1])}};
    return result;
}

ConfigurationResult result_of(const Comparison& comparison)
{
    ConfigurationResult result{comparison.metrics, std::nullopt, {}};
    if (comparison.diagnosis) {
        result.causes = comparison.diagnosis->causes.counts;
        result.peter_panning = comparison.diagnosis->peter_panning;
    }
    return result;
}

FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                              std::uint64_t ordinal, float job_bias)
{
    if (comparison.evaluation && !comparison.diagnosis) {
        FinishedCurve finished;
        finished.curve.id = std::move(curve);
        finished.rows.push_back({ordinal, result_of(comparison)});
        return finished;
    }
    if (!comparison.diagnosis) {
        throw std::invalid_argument("finish_compared: comparison: it has no diagnosis");
    }
    const Diagnosis& diagnosis = *comparison.diagnosis;
    FinishedCurve finished;
    const scene::Image<PixelClass>& classes = comparison.truth.pixel_class;
    const PartMap parts =
        find_parts(classes, comparison.receivers.triangle, diagnosis.zeta_m, *comparison.triangles);
    const LookupRule rule = lookup_rule(comparison.job, comparison.view);
    const scene::Image<float> verdicts = criticals_of_verdicts(comparison.lookup);
    const std::array<float, 1> bias{comparison.view.bias.constant};
    finished.rows.push_back({ordinal, result_of(comparison)});
    finished.rows.back().result.parts =
        count_parts(parts, {classes, comparison.lookup, verdicts, diagnosis.pixels, rule}, bias)
            .front();
    if (!diagnosis.biases) {
        finished.curve = describe_map(std::move(curve), comparison.job, comparison.view);
        finished.curve.by_distance.push_back(
            {DistanceProfile::At::job_bias, comparison.view.bias.constant, diagnosis.by_distance});
        return finished;
    }
    const BiasAnswers& answers = *diagnosis.biases;
    finished.curve =
        describe_curve(std::move(curve),
                       {comparison.job,
                        comparison.view,
                        answers.curve,
                        answers.best,
                        answers.bounds,
                        bin_by_distance(classes, diagnosis.zeta_m),
                        {classes, comparison.lookup, answers.critical_bias, diagnosis.map_error_m},
                        job_bias});
    return finished;
}

} // namespace gnomon::analysis
