// What the bias curve of a lookup says: its shape, what it recommends, and a sweep's rows of it.

#include "analysis/advice/tried_biases.hpp"
#include "analysis/answers/lookup_answers.hpp"
#include "analysis/bias/bias_valley.hpp"
#include "analysis/depth/bin_envelopes.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
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

void LookupAnswers::add_rows(const CurveQuestion& question, const SlopeCurve& curve,
                             FinishedCurve& finished)
{
    const std::vector<float> biases = ascending_biases(question);
    if (biases.empty()) {
        return;
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
    const auto gaps = find_gaps_at(panning_gaps(curve.critical_bias, biases.back()), biases);
    for (const CurveQuestion::Row& row : question.rows) {
        const auto found = std::lower_bound(biases.begin(), biases.end(), row.bias);
        const auto i = static_cast<std::size_t>(found - biases.begin());
        const ErrorCounts& errors = counts[i].errors;
        finished.rows.push_back(
            {row.ordinal,
             {make_metrics(exact_->receivers().classes(),
                           {errors.false_shadow, errors.false_lit, errors_by[i]}),
              counts[i].causes, counts[i].amounts, gaps[i], cells[i]}});
    }
}

CurveResult LookupAnswers::describe_map() const
{
    CurveResult result;
    result.near_m = lookup_.view.frustum.near_m;
    result.far_m = lookup_.view.frustum.far_m;
    result.map_bytes = methods::map_bytes(lookup_.job.shadow_map);
    return result;
}

CurveResult LookupAnswers::describe(const SlopeCurve& curve, float profile_bias)
{
    using At = DistanceProfile::At;
    CurveResult result = describe_map();
    result.best = curve.best;
    result.bounds = curve.bounds;
    result.recommended = recommend(curve);
    const std::vector<float> samples = samples_of(curve);
    const auto errors_by = amounts(curve, samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const ErrorCounts errors = curve.curve.at(samples[i]);
        result.points.push_back(
            {samples[i],
             {curve.curve.lit().size(), curve.curve.blocked().size(), errors.false_shadow,
              errors.false_lit, errors_by[i].shadow, errors_by[i].light}});
    }
    const std::array<float, 2> biases{profile_bias, curve.best.recommended()};
    const BreakdownInputs inputs{classes(), deciding(), curve.critical_bias, map_error_m_,
                                 rule_.promises().equal_taps()};
    auto profiles = errors_by_bin(exact_->distances(), inputs, biases,
                                  has_taps() ? count_lit_taps(classes(), taps(curve.slope), biases)
                                             : std::vector<scene::Image<std::uint8_t>>{});
    for (std::vector<ErrorBin>& profile : profiles) {
        add_envelopes(profile, lookup_.view.frustum, lookup_.job.shadow_map.depth_format);
    }
    result.by_distance = {{At::job_bias, biases[0], std::move(profiles[0])},
                          {At::best_bias, biases[1], std::move(profiles[1])}};
    return result;
}

std::optional<Recommendation> LookupAnswers::recommend(const SlopeCurve& curve)
{
    const auto light_distance_m = exact_->representative_light_distance_m();
    if (curve.curve.lit().empty() || !light_distance_m) {
        return std::nullopt;
    }
    const BiasPlace place{lookup_.view.frustum, lookup_.job.shadow_map.resolution_texels,
                          *light_distance_m};
    return has_taps() ? recommend_by_amount(curve, place)
                      : recommend_by_count(curve.curve, place, lookup_.job.bias);
}

std::optional<Recommendation> LookupAnswers::recommend_by_amount(const SlopeCurve& curve,
                                                                 const BiasPlace& place)
{
    const std::vector<float> biases = tried_biases();
    const std::vector<ErrorAmounts> amounts_of = amounts(curve, biases);
    const std::span<const float> around = around_least(biases, amounts_of);
    const auto softening = softening_with(curve.slope, curve.critical_bias, around);
    std::vector<ErrorPiece> pieces;
    const auto first = static_cast<std::size_t>(around.data() - biases.data());
    for (std::size_t i = 0; i < around.size(); ++i) {
        pieces.push_back(
            {around[i], around[i], amounts_of[first + i].total() - softening[i].total()});
    }
    if (pieces.back().lo == biases.back()) {
        pieces.back().hi = scene::infinity; // from there on everything is lit
    }
    const auto valley = find_valley(pieces);
    if (!valley) {
        return std::nullopt;
    }
    const float middle = valley->middle();
    const PastedBias pasted = pasted_bias(middle, valley->run, lookup_.job.bias, place.frustum);
    std::vector<float> both{middle, pasted.bias};
    std::ranges::sort(both);
    both.erase(std::unique(both.begin(), both.end()), both.end());
    const auto soft = softening_with(curve.slope, curve.critical_bias, both);
    const auto amounts_with = amounts(curve, both);
    const auto outcome_of = [&](float bias) {
        const std::size_t i = bias == both.front() ? 0 : 1;
        return Outcome{curve.curve.at(bias), amounts_with[i], soft[i].total()};
    };
    return Recommendation{place.length_of(middle),
                          place.length_of(valley->run.lo),
                          place.length_of(valley->run.hi),
                          outcome_of(middle),
                          pasted,
                          place.length_of(pasted.bias),
                          outcome_of(pasted.bias),
                          1};
}

FinishedCurve LookupAnswers::answer(const CurveQuestion& question)
{
    const SlopeCurve curve = slope_curve(curves(), question.slope);
    FinishedCurve finished;
    finished.curve = describe(curve, question.job_bias);
    finished.curve.id = question.id;
    add_rows(question, curve, finished);
    return finished;
}

} // namespace gnomon::analysis
