#include "analysis/diagnosis/lookup_answers.hpp"

#include "analysis/diagnosis/bias_answers.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/map_depth_errors.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/recommendation/broad_minimum.hpp"
#include "analysis/recommendation/minimum_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::analysis {

namespace {

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

/// The biases that sample a curve; includes biases up to the end of the last tap's acne.
std::vector<float> samples_of(const SlopeCurve& curve)
{
    constexpr int beyond = 32;
    std::vector<float> biases = sample_biases(curve.curve);
    const double last{biases.back()};
    const double end{curve.bounds.strict.acne_free};
    for (int i = 1; i <= beyond && std::isfinite(end) && last > 0 && end > last; ++i) {
        biases.push_back(
            static_cast<float>(last * std::pow(end / last, static_cast<double>(i) / beyond)));
    }
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

} // namespace

LookupAnswers::LookupAnswers(std::shared_ptr<LightQueryCache> exact, ObservedLookup lookup)
    : causes_{std::move(exact), std::move(lookup)},
      measures_{make_measures(causes_)}
{
}

CurveResult LookupAnswers::describe_map() const
{
    CurveResult result;
    const auto& maps = view().maps;
    result.near_m = std::ranges::min(maps, {}, &scene::LightFrustum::near_m).near_m;
    result.far_m = std::ranges::max(maps, {}, &scene::LightFrustum::far_m).far_m;
    result.map_bytes = causes_.traits().map_bytes;
    return result;
}

CurveResult LookupAnswers::describe(const SlopeCurve& curve, float profile_bias)
{
    using At = DistanceProfile::At;
    CurveResult result = describe_map();
    result.best = curve.best;
    result.bounds = curve.bounds;
    result.peter_panning =
        peter_panning_ ? *peter_panning_ : causes_.find_peter_panning(curve.critical_bias);
    if (causes_.traits().has_fractions()) {
        result.softening_at_zero = measures_->softening_at_zero(curve.slope);
    }
    if (measures_->reruns()) {
        sample_curve(curve, result);
    } else {
        result.recommended = recommend(curve);
        result.points = draw_curve(curve);
    }
    const std::array<float, 2> biases{profile_bias, curve.best.recommended()};
    auto by_bin = measures_->profiles(curve, biases);
    for (std::vector<ErrorBin>& profile : by_bin) {
        add_envelopes(profile, view().maps, job().shadow_map.depth_format);
    }
    result.by_distance = {{At::job_bias, biases[0], std::move(by_bin[0])},
                          {At::best_bias, biases[1], std::move(by_bin[1])}};
    return result;
}

std::vector<CurveSample> LookupAnswers::draw_curve(const SlopeCurve& curve)
{
    const std::vector<float> samples = samples_of(curve);
    const auto errors_by = measures_->amounts(curve, samples);
    std::vector<CurveSample> points;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const ErrorCounts errors = curve.curve.at(samples[i]);
        points.push_back(
            {samples[i],
             {curve.curve.lit().size(), curve.curve.blocked().size(), errors.false_shadow,
              errors.false_lit, errors_by[i].shadow, errors_by[i].light}});
    }
    return points;
}

void LookupAnswers::sample_curve(const SlopeCurve& curve, CurveResult& result)
{
    const std::vector<float> coarse = coarse_biases();
    const CurveSamples found = sample_minimum(curve);
    const auto add = [&](float bias, const ErrorAmounts& at) {
        const ErrorCounts errors = curve.curve.at(bias);
        result.points.push_back({bias,
                                 {curve.curve.lit().size(), curve.curve.blocked().size(),
                                  errors.false_shadow, errors.false_lit, at.shadow, at.light}});
    };
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        if (!found.measured.contains(coarse[i])) {
            add(coarse[i], found.coarse[i]);
        }
    }
    for (const auto& [bias, at] : found.measured) {
        add(bias, at.metrics.amounts);
    }
    if (const float lowest = sample_biases(curve.curve).front(); lowest < 0) {
        const std::array<float, 1> below{lowest}; // no smaller bias changes anything
        add(lowest, measures_->amounts(curve, below).front());
    }
    std::ranges::sort(result.points, {}, &CurveSample::bias);
    result.amounts_are_sampled = true;
    if (const auto lengths = bias_lengths(curve)) {
        result.recommended = recommend_by_amount(curve, *lengths, found.minimum.broad_minimum);
    }
}

std::optional<BiasLengths> LookupAnswers::bias_lengths(const SlopeCurve& curve) const
{
    const auto light_distance_m = causes_.exact().representative_light_distance_m();
    if (curve.curve.lit().empty() || !light_distance_m) {
        return std::nullopt;
    }
    return bias_lengths_in(view(), job().shadow_map.resolution_texels, *light_distance_m,
                           most_read_map(causes_.lookup().layers.maps, classes()));
}

std::optional<Recommendation> LookupAnswers::recommend(const SlopeCurve& curve)
{
    const auto lengths = bias_lengths(curve);
    if (!lengths) {
        return std::nullopt;
    }
    return causes_.has_taps()
               ? recommend_by_amount(curve, *lengths, sample_minimum(curve).minimum.broad_minimum)
               : recommend_by_count(curve.curve, *lengths, job().bias);
}

LookupAnswers::CurveSamples LookupAnswers::sample_minimum(const SlopeCurve& curve)
{
    CurveSamples found;
    const SampledCurve asked{[&](std::span<const float> biases) {
                                 found.coarse = measures_->amounts(curve, biases);
                                 return found.coarse;
                             },
                             [&](std::span<const float> biases) {
                                 std::vector<SoftAmounts> of_each;
                                 for (const MeasuredBias& at : measures_->measure(curve, biases)) {
                                     of_each.push_back({at.metrics.amounts, at.softening});
                                     found.measured.insert_or_assign(at.bias, at);
                                 }
                                 return of_each;
                             }};
    found.minimum = search_broad_minimum(asked, BiasSteps::fine);
    return found;
}

std::optional<Recommendation>
LookupAnswers::recommend_by_amount(const SlopeCurve& curve, const BiasLengths& lengths,
                                   const std::optional<BroadMinimum>& broad_minimum)
{
    if (!broad_minimum) {
        return std::nullopt;
    }
    const RecommendedBias recommended = recommended_bias(broad_minimum->run, lengths);
    const RoundedBias rounded = rounded_near(recommended, broad_minimum->run, broad_minimum->run,
                                             job().bias, lengths.frustum);
    std::vector<float> both{recommended.bias, rounded.bias};
    std::ranges::sort(both);
    both.erase(std::unique(both.begin(), both.end()), both.end());
    const auto measured = measures_->measure(curve, both);
    const auto outcome_of = [&](float bias) {
        return measured[bias == both.front() ? 0 : 1].outcome();
    };
    return Recommendation{lengths.of(recommended.bias),
                          lengths.of(broad_minimum->run.lo),
                          lengths.of(broad_minimum->run.hi),
                          outcome_of(recommended.bias),
                          rounded,
                          lengths.of(rounded.bias),
                          outcome_of(rounded.bias),
                          1,
                          recommended.margin};
}

FinishedCurve LookupAnswers::answer(const CurveQuestion& question)
{
    const SlopeCurve curve = slope_curve(causes_.curves(), question.slope);
    FinishedCurve finished;
    finished.curve = describe(curve, question.job_bias);
    finished.curve.id = question.id;
    const std::vector<float> biases = ascending_biases(question);
    const std::vector<ConfigurationResult> results = measures_->rows(curve, biases);
    finished.curve.verification = measures_->contradictions();
    for (const CurveQuestion::Row& row : question.rows) {
        const auto found = std::lower_bound(biases.begin(), biases.end(), row.bias);
        finished.rows.push_back(
            {row.ordinal, results[static_cast<std::size_t>(found - biases.begin())]});
    }
    return finished;
}

KnownCurve LookupAnswers::find_curve(float profile_bias)
{
    const SlopeInputs inputs = causes_.curves();
    SlopeCurve curve = slope_curve(inputs, view().bias.slope);
    CurveResult described = describe(curve, profile_bias);
    std::optional<NamedErrors> left;
    if (described.recommended) {
        left = measures_->named_errors_at(curve, described.recommended->rounded.bias);
    }
    BiasAnswers answers =
        answer_biases({job(), view(), inputs, causes_.exact().light_distance_m(),
                       causes_.exact().representative_light_distance_m().value_or(0)},
                      std::move(curve), described.recommended);
    return {std::move(described), std::move(answers), left};
}

void LookupAnswers::break_down(const scene::LookupLayers& own, int verdict_taps,
                               Diagnosis& diagnosis) const
{
    const scene::Image<float> no_criticals{diagnosis.biases ? scene::ImageSize{0, 0}
                                                            : classes().size(),
                                           std::numeric_limits<float>::quiet_NaN()};
    const BreakdownInputs inputs{causes_.truth(), own,
                                 diagnosis.biases ? diagnosis.biases->critical_bias : no_criticals,
                                 diagnosis.map_error_m, verdict_taps};
    diagnosis.by_distance = errors_by_bin(causes_.exact().distances(), inputs);
    add_envelopes(diagnosis.by_distance, view().maps, job().shadow_map.depth_format);
    diagnosis.by_angle = errors_by_bin(bin_by_angle(classes(), own), inputs);
    diagnosis.by_object =
        errors_by_object(causes_.truth(), own, causes_.exact().receivers().receivers().triangle,
                         causes_.exact().triangles(), verdict_taps);
    diagnosis.by_map = errors_by_map({causes_.truth(), own, causes_.lookup().layers.maps,
                                      view().maps.size(), diagnosis.causes, verdict_taps});
}

Diagnosis LookupAnswers::diagnose(const scene::LookupLayers& own, const DiagnosisRequest& request,
                                  int verdict_taps) &&
{
    Diagnosis diagnosis;
    ExplainedVerdicts found = causes_.explain(own, view().bias.constant, causes_.rule().slope);
    diagnosis.causes = std::move(found.causes);
    diagnosis.peter_panning = found.peter_panning;
    diagnosis.cells = std::move(found.cells);
    const bool finds_curve = causes_.has_curve() && request.known == nullptr;
    if (finds_curve) {
        // As curves() needs them, while the texels' hits are still cached.
        causes_.require_lit_causes(0, 0);
    }
    if (!measures_->reruns()) {
        if (finds_curve) {
            peter_panning_ =
                causes_.find_peter_panning(causes_.critical_biases(causes_.rule().slope));
        }
        // The following takes the most memory, and needs no hits.
        causes_.exact().forget_texels();
    }
    if (finds_curve) {
        KnownCurve curve = find_curve(request.profile_bias);
        diagnosis.curve = std::move(curve.curve);
        diagnosis.biases = std::move(curve.biases);
        diagnosis.left_by_recommended = curve.left_by_recommended;
        diagnosis.curve.verification = measures_->contradictions();
    } else if (request.known != nullptr) {
        diagnosis.curve = request.known->curve;
        diagnosis.biases = request.known->biases;
        diagnosis.left_by_recommended = request.known->left_by_recommended;
    }
    diagnosis.terms = causes_.take_terms();
    diagnosis.light_distance_m = causes_.exact().light_distance_m();
    diagnosis.map_error_m = causes_.map_error_m();
    break_down(own, verdict_taps, diagnosis);
    if (!diagnosis.biases) {
        diagnosis.curve = describe_map();
        diagnosis.curve.by_distance.push_back(
            {DistanceProfile::At::job_bias, view().bias.constant, diagnosis.by_distance});
    }
    return diagnosis;
}

} // namespace gnomon::analysis
