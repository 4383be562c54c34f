#include "analysis/diagnosis/lookup_answers.hpp"

#include "analysis/diagnosis/bias_answers.hpp"
#include "analysis/lookup/amounts.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "analysis/metrics/bin_envelopes.hpp"
#include "analysis/metrics/map_errors.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/job_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

LookupAnswers::LookupAnswers(std::shared_ptr<ExactLightCache> exact, ObservedLookup lookup)
    : exact_{std::move(exact)},
      lookup_{std::move(lookup)},
      rule_{lookup_rule(lookup_.job, lookup_.view)},
      own_deciding_{make_deciding()},
      causes_{no_causes()},
      knows_blocked_{classes().size()},
      map_error_m_{map_depth_errors_m(cause_inputs(), exact_->centre_hits(cause_inputs()),
                                      lookup_.view.maps, lookup_.job.shadow_map.depth_format)}
{
    remove_bias();
    rerun_exactly();
    find_lit_causes(false);
}

scene::LookupLayers LookupAnswers::make_deciding() const
{
    return has_taps() ? deciding_samples({lookup_.layers.samples, {}, lookup_.layers.maps},
                                         lookup_.layers, lookup_.map_depths, rule_)
                      : scene::LookupLayers{};
}

PixelCauses LookupAnswers::no_causes() const
{
    return {scene::Image<PixelCause>{classes().size()},
            scene::Image<FilterCause>{has_texels() ? classes().size() : scene::ImageSize{0, 0}}};
}

void LookupAnswers::remove_bias()
{
    if (!lookup_.unbiased.samples.empty()) {
        return;
    }
    if (!has_taps()) {
        set_verdicts(lookup_.layers, critical_biases(0), 0);
        return;
    }
    const std::array<float, 1> no_bias{0.0F};
    const auto lit_taps = count_lit_taps(classes(), taps(0), no_bias).front();
    const auto all = static_cast<float>(rule_.promises.tap_count());
    for_each_run(lit_taps.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            lookup_.layers.samples[i].verdict = static_cast<float>(lit_taps[i]) / all;
        }
    });
}

void LookupAnswers::require_lit_causes(float smallest_bias, float slope)
{
    const bool below_zero = (smallest_bias < 0 || slope < 0) && has_texels();
    if (below_zero != knows_lit_below_zero_) {
        find_lit_causes(below_zero);
    }
}

void LookupAnswers::find_lit_causes(bool below_zero)
{
    CauseInputs inputs = cause_inputs();
    inputs.asks_below_zero = below_zero;
    knows_lit_below_zero_ = below_zero;
    exact_->find_lit(inputs, causes_);
}

void LookupAnswers::find_blocked_causes(scene::Image<std::uint8_t> reached)
{
    // Both are 0 or 1. Through local pointers, as a byte may alias an image's own: else the pass
    // over every pixel isn't vectorised.
    std::uint8_t* const asked = reached.data();
    std::uint8_t* const known = knows_blocked_.data();
    const std::size_t count = reached.pixel_count();
    for (std::size_t i = 0; i != count; ++i) {
        asked[i] &= static_cast<std::uint8_t>(~known[i]);
        known[i] |= asked[i];
    }
    if (std::ranges::find(reached, std::uint8_t{1}) != reached.end()) {
        exact_->find_blocked(cause_inputs(), reached, causes_);
    }
}

scene::Image<std::uint8_t> LookupAnswers::reached_by(const scene::Image<float>& criticals,
                                                     const TapCriticals& taps,
                                                     float largest_bias) const
{
    scene::Image<std::uint8_t> reached{classes().size()};
    const auto is_asked = [&](std::size_t pixel) {
        return scene::is_blocked(classes()[pixel]) && knows_blocked_[pixel] == 0;
    };
    for_each_run(reached.pixel_count(), [&](std::size_t first, std::size_t last) {
        if (has_taps()) {
            taps.visit(first, last, is_asked,
                       [&](std::size_t pixel, std::span<const float> of_taps) {
                           reached[pixel] = std::ranges::min(of_taps) <= largest_bias ? 1 : 0;
                       });
            return;
        }
        for (std::size_t i = first; i != last; ++i) {
            reached[i] = is_asked(i) && criticals[i] <= largest_bias ? 1 : 0;
        }
    });
    return reached;
}

CauseInputs LookupAnswers::cause_inputs() const
{
    const scene::LookupLayers& unbiased =
        lookup_.unbiased.samples.empty() ? lookup_.layers : lookup_.unbiased;
    CauseInputs inputs{rule_with(0),
                       lookup_.job.shadow_map.resolution_texels,
                       exact_->receivers().truth(),
                       methods::moves_lookups(lookup_.job, lookup_.view) ? lookup_.layers
                                                                         : unbiased,
                       unbiased,
                       lookup_.map_depths,
                       exact_->light()};
    inputs.exact_reruns = exact_reruns_ ? &*exact_reruns_ : nullptr;
    if (!lookup_.unbiased_map_depths.empty()) {
        inputs.unbiased_map_depths = &lookup_.unbiased_map_depths;
    }
    inputs.terms = lookup_.terms ? &*lookup_.terms : nullptr;
    inputs.missing_receivers = missing_receivers_ ? &*missing_receivers_ : nullptr;
    return inputs;
}

SlopeInputs LookupAnswers::curves()
{
    require_lit_causes(0, 0);
    SlopeInputs inputs{deciding(), rule_, classes(), causes_,
                       forgive_footprints(exact_->gaps(), exact_->light(), exact_->geometry())};
    if (has_texels()) {
        inputs.lookup = &lookup_.layers;
        inputs.map_depths = &lookup_.map_depths;
    }
    if (lookup_.reruns) {
        inputs.find_critical_biases = lookup_.reruns->find_critical_biases;
    }
    return inputs;
}

LookupRule LookupAnswers::rule_with(float slope) const
{
    LookupRule rule = rule_;
    rule.slope = slope;
    return rule;
}

std::vector<ErrorAmounts> LookupAnswers::amounts(const SlopeCurve& curve,
                                                 std::span<const float> biases) const
{
    return has_taps() ? sum_amounts(classes(), taps(curve.slope), biases)
                      : sum_amounts(curve.curve, biases);
}

scene::Image<float> LookupAnswers::critical_biases(float slope) const
{
    if (!has_curve()) {
        throw std::invalid_argument(
            "critical_biases: the renderers find none, and the lookup has no formula");
    }
    return lookup_.reruns ? lookup_.reruns->find_critical_biases(slope)
                          : analysis::critical_biases(deciding(), rule_with(slope));
}

void LookupAnswers::break_down(const scene::LookupLayers& own, int verdict_taps,
                               Diagnosis& diagnosis) const
{
    const scene::Image<float> no_criticals{diagnosis.biases ? scene::ImageSize{0, 0}
                                                            : classes().size(),
                                           std::numeric_limits<float>::quiet_NaN()};
    const BreakdownInputs inputs{truth(), own,
                                 diagnosis.biases ? diagnosis.biases->critical_bias : no_criticals,
                                 diagnosis.map_error_m, verdict_taps};
    diagnosis.by_distance = errors_by_bin(exact_->distances(), inputs);
    add_envelopes(diagnosis.by_distance, lookup_.view.maps, lookup_.job.shadow_map.depth_format);
    diagnosis.by_angle = errors_by_bin(bin_by_angle(classes(), own), inputs);
    diagnosis.by_object = errors_by_object(truth(), own, exact_->receivers().receivers().triangle,
                                           exact_->triangles(), verdict_taps);
    diagnosis.by_map = errors_by_map({truth(), own, lookup_.layers.maps, lookup_.view.maps.size(),
                                      diagnosis.causes, verdict_taps});
}

CauseLayers LookupAnswers::causes_of(const scene::LookupLayers& own, float constant, float slope)
{
    scene::Image<std::uint8_t> reached{classes().size()};
    for (std::size_t i = 0; i < reached.pixel_count(); ++i) {
        reached[i] =
            scene::is_blocked(classes()[i]) && double{own.samples[i].verdict} > partial_above;
    }
    find_blocked_causes(std::move(reached));
    require_lit_causes(constant, slope);
    const TapCriticals taps_of_slope = taps(slope);
    return classify_errors({classes(), own, criticals_of_verdicts(own), causes_, rule_with(slope),
                            has_texels() ? &taps_of_slope : nullptr, true},
                           constant);
}

LookupAnswers::Explained LookupAnswers::explain(const scene::LookupLayers& own, float constant,
                                                float slope)
{
    const std::array<float, 1> bias{constant};
    const scene::Image<float> verdicts = criticals_of_verdicts(own);
    CauseLayers causes = causes_of(own, constant, slope);
    const TapCriticals own_taps = taps(slope);
    const BiasRowInputs inputs{
        classes(), own, verdicts, causes_, rule_with(slope), has_texels() ? &own_taps : nullptr,
        true};
    return {std::move(causes), gaps_at(verdicts, slope, bias).front(),
            count_error_cells(exact_->cells(), inputs, bias).front()};
}

std::vector<Softening> LookupAnswers::softening_with(float slope,
                                                     const scene::Image<float>& criticals,
                                                     std::span<const float> biases)
{
    require_lit_causes(biases.front(), slope);
    const TapCriticals taps_of_slope = taps(slope);
    find_blocked_causes(reached_by(criticals, taps_of_slope, biases.back()));
    return softening_at({classes(), deciding(), criticals, causes_, rule_with(slope),
                         has_texels() ? &taps_of_slope : nullptr},
                        biases);
}

Softening LookupAnswers::softening_at_zero(float slope)
{
    if (!rule_.promises.has_fractions()) {
        return {};
    }
    if (const auto known = softening_at_zero_.find(slope); known != softening_at_zero_.end()) {
        return known->second;
    }
    Softening found;
    if (lookup_.reruns) {
        const CauseAmounts amounts = causes_of(lookup_.reruns->look_up(0, slope), 0, slope).amounts;
        found = {amounts.shadow_softening, amounts.light_softening};
    } else {
        const std::array<float, 1> none{0.0F};
        found = softening_with(slope, critical_biases(slope), none).front();
    }
    softening_at_zero_.emplace(slope, found);
    return found;
}

std::vector<MeasuredBias> LookupAnswers::measure_biases(float slope, std::span<const float> biases)
{
    if (lookup_.reruns) {
        return rerun(slope, biases, lookups_with(slope));
    }
    const scene::Image<float> criticals = critical_biases(slope);
    const BiasCurve curve{criticals, classes()};
    const auto errors_by = amounts_at(slope, biases);
    const auto softening = softening_with(slope, criticals, biases);
    std::vector<MeasuredBias> measured;
    for (std::size_t i = 0; i < biases.size(); ++i) {
        const ErrorCounts errors = curve.at(biases[i]);
        measured.push_back({biases[i],
                            make_metrics(exact_->receivers().classes(),
                                         {errors.false_shadow, errors.false_lit, errors_by[i]}),
                            softening[i], softening_at_zero(slope)});
    }
    return measured;
}

std::vector<ErrorAmounts> LookupAnswers::amounts_at(float slope,
                                                    std::span<const float> biases) const
{
    if (lookup_.reruns) {
        return rerun_amounts(biases, lookups_with(slope));
    }
    return has_taps() ? sum_amounts(classes(), taps(slope), biases)
                      : sum_amounts(BiasCurve{critical_biases(slope), classes()}, biases);
}

KnownCurve LookupAnswers::find_curve(float profile_bias)
{
    const SlopeInputs inputs = curves();
    SlopeCurve curve = slope_curve(inputs, lookup_.view.bias.slope);
    CurveResult described = describe(curve, profile_bias);
    std::optional<NamedErrors> left;
    if (described.recommended) {
        left = left_by(curve, described.recommended->pasted.bias);
    }
    BiasAnswers answers =
        answer_biases({lookup_.job, lookup_.view, inputs, exact_->light_distance_m(),
                       exact_->representative_light_distance_m().value_or(0)},
                      std::move(curve), described.recommended);
    return {std::move(described), std::move(answers), left};
}

Diagnosis LookupAnswers::diagnose(const scene::LookupLayers& own, const DiagnosisRequest& request,
                                  int verdict_taps) &&
{
    Diagnosis diagnosis;
    Explained found = explain(own, lookup_.view.bias.constant, rule_.slope);
    diagnosis.causes = std::move(found.causes);
    diagnosis.peter_panning = found.peter_panning;
    diagnosis.cells = std::move(found.cells);
    const bool finds_curve = has_curve() && request.known == nullptr;
    if (finds_curve) {
        require_lit_causes(0, 0); // as curves() asks, while what the rays saw is still known
    }
    if (!lookup_.reruns) {
        if (finds_curve) {
            peter_panning_ = find_peter_panning(critical_biases(rule_.slope));
        }
        exact_->forget_texels(); // what follows takes the most memory, and asks no more of them
    }
    if (finds_curve) {
        KnownCurve curve = find_curve(request.profile_bias);
        diagnosis.curve = std::move(curve.curve);
        diagnosis.biases = std::move(curve.biases);
        diagnosis.left_by_recommended = curve.left_by_recommended;
        diagnosis.curve.verification = contradictions_;
    } else if (request.known != nullptr) {
        diagnosis.curve = request.known->curve;
        diagnosis.biases = request.known->biases;
        diagnosis.left_by_recommended = request.known->left_by_recommended;
    }
    if (lookup_.terms) {
        diagnosis.terms = std::move(lookup_.terms->lookup);
    }
    diagnosis.light_distance_m = exact_->light_distance_m();
    diagnosis.map_error_m = map_error_m_;
    break_down(own, verdict_taps, diagnosis);
    if (!diagnosis.biases) {
        diagnosis.curve = describe_map();
        diagnosis.curve.by_distance.push_back(
            {DistanceProfile::At::job_bias, lookup_.view.bias.constant, diagnosis.by_distance});
    }
    return diagnosis;
}

} // namespace gnomon::analysis
