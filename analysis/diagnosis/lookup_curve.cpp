// What the bias curve of a lookup says: its shape, what it recommends, and a sweep's rows of it.

#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/metrics/bin_envelopes.hpp"
#include "analysis/metrics/map_rows.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "analysis/recommendation/bias_valley.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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

/// The biases that a curve is drawn at; beyond the last pixel's side of one half up to where the
/// last tap's acne ends.
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

std::vector<ConfigurationResult> LookupAnswers::rows(const SlopeCurve& curve,
                                                     std::span<const float> biases)
{
    if (biases.empty()) {
        return {};
    }
    if (lookup_.reruns) {
        return rerun_rows(curve, biases);
    }
    require_lit_causes(biases.front(), curve.slope);
    const TapCriticals taps_of_slope = taps(curve.slope);
    find_blocked_causes(reached_by(curve.critical_bias, taps_of_slope, biases.back()));
    const BiasRowInputs inputs{classes(),
                               deciding(),
                               curve.critical_bias,
                               causes_,
                               rule_with(curve.slope),
                               has_texels() ? &taps_of_slope : nullptr};
    const auto errors_by = amounts(curve, biases);
    const auto counts = count_rows(inputs, curve.curve, errors_by, biases);
    const auto cells = count_error_cells(exact_->cells(), inputs, biases);
    const auto by_map =
        count_map_errors(lookup_.layers.maps, lookup_.view.maps.size(), inputs, biases);
    const auto gaps = gaps_at(curve.critical_bias, curve.slope, biases);
    std::vector<ConfigurationResult> rows;
    for (std::size_t i = 0; i < biases.size(); ++i) {
        const ErrorCounts& errors = counts[i].errors;
        rows.push_back({make_metrics(exact_->receivers().classes(),
                                     {errors.false_shadow, errors.false_lit, errors_by[i]}),
                        counts[i].causes, counts[i].amounts, gaps[i], cells[i],
                        maps_at(biases[i], by_map[i])});
    }
    return rows;
}

std::vector<MapResult> LookupAnswers::maps_at(float bias,
                                              const std::vector<MapErrors>& errors) const
{
    if (errors.empty()) {
        return {};
    }
    scene::View view = lookup_.view;
    view.bias.constant = bias;
    return results_of_maps(lookup_.job, view, errors);
}

CurveResult LookupAnswers::describe_map() const
{
    CurveResult result;
    const auto& maps = lookup_.view.maps;
    result.near_m = std::ranges::min(maps, {}, &scene::LightFrustum::near_m).near_m;
    result.far_m = std::ranges::max(maps, {}, &scene::LightFrustum::far_m).far_m;
    result.map_bytes = rule_.promises.map_bytes;
    return result;
}

CurveResult LookupAnswers::describe(const SlopeCurve& curve, float profile_bias)
{
    using At = DistanceProfile::At;
    CurveResult result = describe_map();
    result.best = curve.best;
    result.bounds = curve.bounds;
    result.peter_panning =
        peter_panning_ ? *peter_panning_ : find_peter_panning(curve.critical_bias);
    if (rule_.promises.has_fractions()) {
        result.softening_at_zero = softening_at_zero(curve.slope);
    }
    if (lookup_.reruns) {
        sample_curve(curve, result);
    } else {
        result.recommended = recommend(curve);
        result.points = draw_curve(curve);
    }
    const std::array<float, 2> biases{profile_bias, curve.best.recommended()};
    auto by_bin = lookup_.reruns ? rerun_profiles(curve, biases) : profiles(curve, biases);
    for (std::vector<ErrorBin>& profile : by_bin) {
        add_envelopes(profile, lookup_.view.maps, lookup_.job.shadow_map.depth_format);
    }
    result.by_distance = {{At::job_bias, biases[0], std::move(by_bin[0])},
                          {At::best_bias, biases[1], std::move(by_bin[1])}};
    return result;
}

std::vector<CurveSample> LookupAnswers::draw_curve(const SlopeCurve& curve) const
{
    const std::vector<float> samples = samples_of(curve);
    const auto errors_by = amounts(curve, samples);
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

std::vector<std::vector<ErrorBin>> LookupAnswers::profiles(const SlopeCurve& curve,
                                                           std::span<const float> biases) const
{
    const BreakdownInputs inputs{truth(), deciding(), curve.critical_bias, map_error_m_,
                                 rule_.promises.equal_taps()};
    return errors_by_bin(exact_->distances(), inputs, biases,
                         has_taps() ? count_lit_taps(classes(), taps(curve.slope), biases)
                                    : std::vector<scene::Image<std::uint8_t>>{});
}

std::optional<BiasLengths> LookupAnswers::bias_lengths(const SlopeCurve& curve) const
{
    const auto light_distance_m = exact_->representative_light_distance_m();
    if (curve.curve.lit().empty() || !light_distance_m) {
        return std::nullopt;
    }
    return bias_lengths_in(lookup_.view, lookup_.job.shadow_map.resolution_texels,
                           *light_distance_m, most_read_map(lookup_.layers.maps, classes()));
}

std::optional<Recommendation> LookupAnswers::recommend(const SlopeCurve& curve)
{
    const auto lengths = bias_lengths(curve);
    if (!lengths) {
        return std::nullopt;
    }
    return has_taps() ? recommend_by_amount(curve, *lengths, try_biases(curve).tried.valley)
                      : recommend_by_count(curve.curve, *lengths, lookup_.job.bias);
}

LookupAnswers::TriedCurve LookupAnswers::try_biases(const SlopeCurve& curve)
{
    TriedCurve found;
    const AskedCurve asked{[&](std::span<const float> biases) {
                               found.coarse = lookup_.reruns
                                                  ? rerun_amounts(biases, lookups_held_to(curve))
                                                  : amounts(curve, biases);
                               return found.coarse;
                           },
                           [&](std::span<const float> biases) {
                               std::vector<SoftAmounts> of_each;
                               for (const MeasuredBias& at : measure(curve, biases)) {
                                   of_each.push_back({at.metrics.amounts, at.softening});
                                   found.measured.insert_or_assign(at.bias, at);
                               }
                               return of_each;
                           }};
    found.tried = search_valley(asked, BiasSteps::fine);
    return found;
}

std::vector<MeasuredBias> LookupAnswers::measure(const SlopeCurve& curve,
                                                 std::span<const float> biases)
{
    return lookup_.reruns ? rerun(curve.slope, biases, lookups_held_to(curve))
                          : measure_by_formula(curve, biases);
}

std::vector<MeasuredBias> LookupAnswers::measure_by_formula(const SlopeCurve& curve,
                                                            std::span<const float> biases)
{
    const std::vector<ErrorAmounts> amounts_of = amounts(curve, biases);
    const auto softening = softening_with(curve.slope, curve.critical_bias, biases);
    std::vector<MeasuredBias> measured;
    for (std::size_t i = 0; i < biases.size(); ++i) {
        const ErrorCounts errors = curve.curve.at(biases[i]);
        measured.push_back({biases[i],
                            make_metrics(exact_->receivers().classes(),
                                         {errors.false_shadow, errors.false_lit, amounts_of[i]}),
                            softening[i], softening_at_zero(curve.slope)});
    }
    return measured;
}

std::optional<Recommendation>
LookupAnswers::recommend_by_amount(const SlopeCurve& curve, const BiasLengths& lengths,
                                   const std::optional<BiasValley>& valley)
{
    if (!valley) {
        return std::nullopt;
    }
    const RecommendedBias recommended = recommended_bias(valley->run, lengths);
    const PastedBias pasted =
        pasted_near(recommended, valley->run, valley->run, lookup_.job.bias, lengths.frustum);
    std::vector<float> both{recommended.bias, pasted.bias};
    std::ranges::sort(both);
    both.erase(std::unique(both.begin(), both.end()), both.end());
    const auto measured = measure(curve, both);
    const auto outcome_of = [&](float bias) {
        return measured[bias == both.front() ? 0 : 1].outcome();
    };
    return Recommendation{lengths.of(recommended.bias),
                          lengths.of(valley->run.lo),
                          lengths.of(valley->run.hi),
                          outcome_of(recommended.bias),
                          pasted,
                          lengths.of(pasted.bias),
                          outcome_of(pasted.bias),
                          1,
                          recommended.margin};
}

NamedErrors LookupAnswers::left_by(const SlopeCurve& curve, float bias)
{
    const std::array<float, 1> biases{bias};
    const auto named = [&](const CauseCounts& counts, const CauseAmounts& amounts) {
        const Softening own{amounts.shadow_softening, amounts.light_softening};
        return named_errors(counts, amounts, rule_.promises.has_fractions(),
                            left_out(own, softening_at_zero(curve.slope)).total());
    };
    if (lookup_.reruns) {
        const CauseLayers causes = causes_of(lookups_with(curve.slope)(bias), bias, curve.slope);
        return named(causes.counts, causes.amounts);
    }
    require_lit_causes(bias, curve.slope);
    const TapCriticals taps_of_slope = taps(curve.slope);
    find_blocked_causes(reached_by(curve.critical_bias, taps_of_slope, bias));
    const BiasRow row =
        count_rows({classes(), deciding(), curve.critical_bias, causes_, rule_with(curve.slope),
                    has_texels() ? &taps_of_slope : nullptr},
                   curve.curve, amounts(curve, biases), biases)
            .front();
    return named(row.causes, row.amounts);
}

FinishedCurve LookupAnswers::answer(const CurveQuestion& question)
{
    const SlopeCurve curve = slope_curve(curves(), question.slope);
    FinishedCurve finished;
    finished.curve = describe(curve, question.job_bias);
    finished.curve.id = question.id;
    const std::vector<float> biases = ascending_biases(question);
    const std::vector<ConfigurationResult> results = rows(curve, biases);
    finished.curve.verification = contradictions_;
    for (const CurveQuestion::Row& row : question.rows) {
        const auto found = std::lower_bound(biases.begin(), biases.end(), row.bias);
        finished.rows.push_back(
            {row.ordinal, results[static_cast<std::size_t>(found - biases.begin())]});
    }
    return finished;
}

} // namespace gnomon::analysis
