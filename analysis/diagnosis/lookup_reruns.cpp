// What GL's own lookups with other biases, or over exact depths, say, where no formula tells.

#include "analysis/causes/exact_primitives.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/recommendation/tried_biases.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

namespace {

/// Critical biases that say nothing but whether verdicts are so high: −∞ or +∞.
scene::Image<float> criticals_of(const scene::Image<float>& verdicts, float lit_from)
{
    scene::Image<float> criticals{verdicts.size()};
    for (std::size_t i = 0; i < verdicts.pixel_count(); ++i) {
        criticals[i] = verdicts[i] >= lit_from ? -scene::infinity : scene::infinity;
    }
    return criticals;
}

/// Takes over what was found of lit pixels.
void take_lit(const scene::Image<scene::PixelClass>& classes, const ExactReruns& of_lit,
              ExactReruns& all)
{
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_lit(classes[i])) {
            all.any[i] = of_lit.any[i];
            all.half[i] = of_lit.half[i];
            all.full[i] = of_lit.full[i];
        }
    }
}

} // namespace

void LookupAnswers::rerun_exactly()
{
    if (rule_.promises.compares_depths()) {
        return;
    }
    if (rule_.promises.compares == methods::Compares::primitives) {
        CauseInputs inputs = cause_inputs();
        inputs.known_hits = &exact_->centre_hits(inputs).hits();
        const auto& receivers = exact_->receivers().receivers().triangle;
        exact_reruns_ = find_exact_primitives(inputs, receivers);
        missing_receivers_ =
            find_missing_receivers(inputs, receivers, exact_->triangles(), lookup_.view.light,
                                   lookup_.job.shadow_map.cull);
        return;
    }
    const ExactRun& run = *lookup_.exact_run;
    const CauseInputs inputs = cause_inputs();
    const renderers::ExactDepths depths = exact_->exact_depths(inputs, run.places, run.layers);
    exact_reruns_ = run_exactly(depths, {});
    const scene::Bias& own = lookup_.view.bias;
    if (lookup_.terms) {
        const KeptDepths kept{depths, inputs};
        take_lit(classes(), run_exactly(kept.depths(), own), *exact_reruns_);
    } else if (!run.find_critical_biases) {
        take_lit(classes(), run_exactly(depths, {.constant = own.constant, .slope = own.slope}),
                 *exact_reruns_);
    }
}

ExactReruns LookupAnswers::run_exactly(const renderers::ExactDepths& depths,
                                       const scene::Bias& bias) const
{
    constexpr float partial{partial_above};
    const std::array<float, 3> lit_from{std::nextafter(partial, 1.0F), 0.5F, 1 - partial};
    const ExactRun& run = *lookup_.exact_run;
    if (run.find_critical_biases) {
        auto criticals = run.find_critical_biases(depths, bias, lit_from);
        return {std::move(criticals[0]), std::move(criticals[1]), std::move(criticals[2])};
    }
    if (!run.look_up) {
        throw std::invalid_argument(
            "LookupAnswers: the renderers cannot run the job's method over exact depths");
    }
    const auto verdicts = run.look_up(depths, std::span{&bias, 1}).front();
    return {criticals_of(verdicts, lit_from[0]), criticals_of(verdicts, lit_from[1]),
            criticals_of(verdicts, lit_from[2])};
}

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
        measured.push_back({bias,
                            analysis::measure(truth(), own, rule_.promises.equal_taps()),
                            {amounts.shadow_softening, amounts.light_softening},
                            softening_at_zero(slope)});
    }
    return measured;
}

std::vector<ErrorAmounts> LookupAnswers::rerun_amounts(std::span<const float> biases,
                                                       const LookUp& look_up) const
{
    std::vector<ErrorAmounts> amounts;
    for (const float bias : biases) {
        amounts.push_back(
            analysis::measure(truth(), look_up(bias), rule_.promises.equal_taps()).amounts);
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
        const auto by_map =
            errors_by_map({truth(), own, lookup_.layers.maps, lookup_.view.maps.size(),
                           found.causes, rule_.promises.equal_taps()});
        rows.push_back({analysis::measure(truth(), own, rule_.promises.equal_taps()),
                        found.causes.counts, found.causes.amounts, found.peter_panning,
                        std::move(found.cells), maps_at(bias, by_map)});
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
            errors_by_bin(exact_->distances(), {truth(), own, curve.critical_bias, map_error_m_,
                                                rule_.promises.equal_taps()}));
    }
    return profiles;
}

void LookupAnswers::sample_curve(const SlopeCurve& curve, CurveResult& result)
{
    const std::vector<float> coarse = coarse_biases();
    const TriedCurve found = try_biases(curve);
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
        const std::array<float, 1> below{lowest}; // from there on down nothing changes
        add(lowest, rerun_amounts(below, lookups_held_to(curve)).front());
    }
    std::ranges::sort(result.points, {}, &CurveSample::bias);
    result.amounts_are_sampled = true;
    if (const auto lengths = bias_lengths(curve)) {
        result.recommended = recommend_by_amount(curve, *lengths, found.tried.valley);
    }
}

} // namespace gnomon::analysis
