// What GL's own lookups with other biases say, where no formula tells.

#include "analysis/answers/lookup_answers.hpp"
#include "analysis/recommendation/tried_biases.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::analysis {

LookupAnswers::LookUp LookupAnswers::lookups_with(float slope) const
{
    return [this, slope](float bias) { return lookup_.reruns->look_up(bias, slope); };
}

LookupAnswers::LookUp LookupAnswers::lookups_held_to(const SlopeCurve& curve)
{
    return [this, &curve](float bias) { return look_up_again(curve, bias); };
}

std::vector<MeasuredBias> LookupAnswers::rerun(float slope, std::span<const float> biases,
                                               const LookUp& look_up)
{
    std::vector<MeasuredBias> measured;
    for (const float bias : biases) {
        const scene::LookupLayers own = look_up(bias);
        const CauseAmounts amounts = causes_of(own, bias, slope).amounts;
        measured.push_back(
            {bias,
             analysis::measure(exact_->receivers().truth(), own, rule_.promises.equal_taps()),
             {amounts.shadow_softening, amounts.light_softening}});
    }
    return measured;
}

std::vector<ErrorAmounts> LookupAnswers::rerun_amounts(std::span<const float> biases,
                                                       const LookUp& look_up) const
{
    std::vector<ErrorAmounts> amounts;
    for (const float bias : biases) {
        amounts.push_back(analysis::measure(exact_->receivers().truth(), look_up(bias),
                                            rule_.promises.equal_taps())
                              .amounts);
    }
    return amounts;
}

scene::LookupLayers LookupAnswers::look_up_again(const SlopeCurve& curve, float bias)
{
    scene::LookupLayers own = lookup_.reruns->look_up(bias, curve.slope);
    const BiasVerification::Rerun held =
        hold_to_curve(own, exact_->receivers().receivers().triangle, curve.critical_bias, bias);
    if (held.differences > 0) {
        add_reruns(contradictions_, {{held}});
    }
    return own;
}

std::vector<ConfigurationResult> LookupAnswers::rerun_rows(const SlopeCurve& curve,
                                                           std::span<const float> biases)
{
    std::vector<ConfigurationResult> rows;
    for (const float bias : biases) {
        const scene::LookupLayers own = look_up_again(curve, bias);
        Explained found = explain(own, bias, curve.slope);
        rows.push_back(
            {analysis::measure(exact_->receivers().truth(), own, rule_.promises.equal_taps()),
             found.causes.counts, found.causes.amounts, found.peter_panning,
             std::move(found.cells)});
    }
    return rows;
}

std::vector<std::vector<ErrorBin>> LookupAnswers::rerun_profiles(const SlopeCurve& curve,
                                                                 std::span<const float> biases)
{
    std::vector<std::vector<ErrorBin>> profiles;
    for (const float bias : biases) {
        const scene::LookupLayers own = look_up_again(curve, bias);
        profiles.push_back(
            errors_by_bin(exact_->distances(), {classes(), own, curve.critical_bias, map_error_m_,
                                                rule_.promises.equal_taps()}));
    }
    return profiles;
}

void LookupAnswers::sample_curve(const SlopeCurve& curve, CurveResult& result)
{
    const std::vector<float> coarse = coarse_biases();
    const LookUp look_up = lookups_held_to(curve);
    const std::vector<ErrorAmounts> amounts = rerun_amounts(coarse, look_up);
    const std::vector<MeasuredBias> around =
        rerun(curve.slope, fine_biases_around_least(coarse, amounts), look_up);
    const auto add = [&](float bias, const ErrorAmounts& at) {
        const ErrorCounts errors = curve.curve.at(bias);
        result.points.push_back({bias,
                                 {curve.curve.lit().size(), curve.curve.blocked().size(),
                                  errors.false_shadow, errors.false_lit, at.shadow, at.light}});
    };
    for (std::size_t i = 0; i < coarse.size(); ++i) {
        if (std::ranges::find(around, coarse[i], &MeasuredBias::bias) == around.end()) {
            add(coarse[i], amounts[i]);
        }
    }
    for (const MeasuredBias& at : around) {
        add(at.bias, at.metrics.amounts);
    }
    if (const float lowest = sample_biases(curve.curve).front(); lowest < 0) {
        const std::array<float, 1> below{lowest}; // from there on down nothing changes
        add(lowest, rerun_amounts(below, look_up).front());
    }
    std::ranges::sort(result.points, {}, &CurveSample::bias);
    result.amounts_are_sampled = true;
    if (const auto lengths = bias_lengths(curve)) {
        result.recommended = recommend_by_amount(curve, *lengths, around);
    }
}

} // namespace gnomon::analysis
