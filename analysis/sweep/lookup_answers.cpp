#include "analysis/sweep/lookup_answers.hpp"

#include "analysis/bias_answers.hpp"
#include "analysis/depth/bin_envelopes.hpp"
#include "analysis/map_errors.hpp"
#include "analysis/tune.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

/// A curve, and what its description is made from.
struct DescribedCurve {
    const scene::Job& job;
    const scene::View& view;
    const BiasCurve& curve;
    const BestBiases& best;
    const BiasBounds& bounds;
    const Binning& distances;
    const BreakdownInputs& inputs;
    float job_bias;
};

CurveResult describe_map(std::string id, const scene::Job& job, const scene::View& view)
{
    CurveResult result;
    result.id = std::move(id);
    result.near_m = view.frustum.near_m;
    result.far_m = view.frustum.far_m;
    result.map_bytes = map_bytes(job.shadow_map);
    return result;
}

CurveResult describe(std::string id, const DescribedCurve& described)
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

std::vector<float> ascending_biases(const CurveQuestion& question)
{
    std::vector<float> biases;
    for (const CurveQuestion::Row& row : question.rows) {
        biases.push_back(row.bias);
    }
    std::sort(biases.begin(), biases.end());
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

} // namespace

LookupAnswers::LookupAnswers(std::shared_ptr<ExactSide> exact, SweepLookup lookup)
    : exact_{std::move(exact)},
      lookup_{std::move(lookup)},
      rule_{lookup_rule(lookup_.job, lookup_.view)},
      own_deciding_{make_deciding()},
      causes_{exact_->causes(cause_inputs())},
      map_error_m_{map_depth_errors_m(cause_inputs(), exact_->centre_hits(cause_inputs()),
                                      lookup_.view.frustum, lookup_.job.shadow_map.depth_format)}
{
}

scene::LookupLayers LookupAnswers::make_deciding() const
{
    return equal_taps(rule_.filter) > 1
               ? deciding_samples({lookup_.layers.samples}, lookup_.layers.texels,
                                  lookup_.map_depths, rule_)
               : scene::LookupLayers{};
}

CauseInputs LookupAnswers::cause_inputs() const
{
    const bool is_moved = !lookup_.unmoved.samples.empty();
    return {lookup_.job.lookup,
            lookup_.job.shadow_map.resolution_texels,
            lookup_.view.frustum.reversed,
            exact_->subject().truth,
            is_moved ? lookup_.unmoved : lookup_.layers,
            lookup_.map_depths,
            exact_->light()};
}

std::vector<PanningGap> LookupAnswers::panning_gaps(const scene::Image<float>& critical,
                                                    float largest_bias)
{
    std::vector<std::size_t> panning;
    for (std::size_t i = 0; i < critical.pixel_count(); ++i) {
        if (classes()[i] == PixelClass::blocked && causes_[i].unbiased == Cause::none &&
            critical[i] <= largest_bias) {
            panning.push_back(i);
        }
    }
    panning = exact_->detached(cause_inputs(), panning);
    const auto lengths = exact_->pixel_gaps(panning);
    std::vector<PanningGap> gaps;
    gaps.reserve(panning.size());
    for (std::size_t i = 0; i < panning.size(); ++i) {
        gaps.push_back({critical[panning[i]], lengths[i]});
    }
    return gaps;
}

void LookupAnswers::add_rows(const CurveQuestion& question, const scene::Image<float>& critical,
                             const BiasCurve& curve, const LookupRule& rule,
                             FinishedCurve& finished)
{
    const std::vector<float> biases = ascending_biases(question);
    if (biases.empty()) {
        return;
    }
    const int taps = equal_taps(rule.filter);
    const BiasRowInputs inputs{classes(), deciding(), critical, causes_, rule};
    const auto counts = count_rows(inputs, curve, biases);
    const auto parts = count_parts(exact_->parts(), inputs, biases);
    const auto wrong_taps =
        taps > 1 ? count_wrong_taps(classes(), lookup_.layers, lookup_.map_depths, rule, biases)
                 : std::vector<std::uint64_t>{};
    const auto gaps = find_gaps_at(panning_gaps(critical, biases.back()), biases);
    for (const CurveQuestion::Row& row : question.rows) {
        const auto found = std::lower_bound(biases.begin(), biases.end(), row.bias);
        const auto i = static_cast<std::size_t>(found - biases.begin());
        const ErrorCounts& errors = counts[i].errors;
        const std::uint64_t wrong = taps > 1 ? wrong_taps[i] : errors.total();
        finished.rows.push_back(
            {row.ordinal,
             {make_metrics(exact_->subject().classes, {errors.false_shadow, errors.false_lit,
                                                       static_cast<double>(wrong) / taps}),
              counts[i].causes, gaps[i], parts[i]}});
    }
}

scene::Image<float> LookupAnswers::critical_biases(float slope) const
{
    LookupRule rule = rule_;
    rule.slope = slope;
    return analysis::critical_biases(deciding(), rule);
}

FinishedCurve LookupAnswers::answer(const CurveQuestion& question)
{
    LookupRule rule = rule_;
    rule.slope = question.slope;
    const scene::Image<float> critical = critical_biases(question.slope);
    const BiasCurve curve{critical, classes()};
    const BestBiases best = find_best_biases(curve);
    const BiasBounds bounds =
        find_bias_bounds(curve, critical, classes(), acne_flags(classes(), causes_),
                         forgive_footprints(exact_->gaps(), exact_->light(), exact_->geometry()));
    FinishedCurve finished;
    finished.curve = describe(question.id, {lookup_.job,
                                            lookup_.view,
                                            curve,
                                            best,
                                            bounds,
                                            exact_->distances(),
                                            {classes(), deciding(), critical, map_error_m_},
                                            question.job_bias});
    add_rows(question, critical, curve, rule, finished);
    return finished;
}

FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                              std::uint64_t ordinal, float job_bias)
{
    if (comparison.evaluation && !comparison.diagnosis) {
        FinishedCurve finished;
        finished.curve.id = std::move(curve);
        finished.rows.push_back({ordinal, {comparison.metrics, std::nullopt, {}}});
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
    finished.rows.push_back(
        {ordinal,
         {comparison.metrics, diagnosis.causes.counts, diagnosis.peter_panning,
          count_parts(parts, classes, diagnosis.causes.cause, diagnosis.causes.label)}});
    if (!diagnosis.biases) {
        finished.curve = describe_map(std::move(curve), comparison.job, comparison.view);
        finished.curve.by_distance.push_back(
            {DistanceProfile::At::job_bias, comparison.view.bias.constant, diagnosis.by_distance});
        return finished;
    }
    const BiasAnswers& answers = *diagnosis.biases;
    finished.curve =
        describe(std::move(curve),
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
