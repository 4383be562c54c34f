#include "analysis/answers/lookup_answers.hpp"

#include "analysis/advice/bias_valley.hpp"
#include "analysis/advice/map_cost.hpp"
#include "analysis/advice/tried_biases.hpp"
#include "analysis/bias_answers.hpp"
#include "analysis/depth/bin_envelopes.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "analysis/map_errors.hpp"
#include "analysis/pixel_runs.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace gnomon::analysis {

using scene::PixelClass;

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

ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                              scene::LookupLayers layers, const Renderers& renderers)
{
    ObservedLookup lookup{job, view, std::move(layers), {}, {}};
    if (!can_derive_unbiased(job, view)) {
        scene::View unbiased = view;
        unbiased.bias = {};
        lookup.unbiased = renderers.look_up(job, unbiased);
    }
    if (!scene::promises(job.lookup.filter).has_one_tap()) {
        lookup.map_depths = renderers.read_map_depths();
    }
    return lookup;
}

LookupAnswers::LookupAnswers(std::shared_ptr<ExactLightCache> exact, ObservedLookup lookup)
    : exact_{std::move(exact)},
      lookup_{std::move(lookup)},
      rule_{lookup_rule(lookup_.job, lookup_.view)},
      own_deciding_{make_deciding()},
      causes_{no_causes()},
      knows_blocked_{classes().size()},
      map_error_m_{map_depth_errors_m(cause_inputs(), exact_->centre_hits(cause_inputs()),
                                      lookup_.view.frustum, lookup_.job.shadow_map.depth_format)}
{
    remove_bias();
    find_lit_causes(false);
}

scene::LookupLayers LookupAnswers::make_deciding() const
{
    return scene::promises(rule_.filter).equal_taps() > 1
               ? deciding_samples({lookup_.layers.samples}, lookup_.layers.texels,
                                  lookup_.map_depths, rule_)
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
    const auto all = static_cast<float>(rule_.promises().tap_count());
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
    for_each_run(reached.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            reached[i] &= static_cast<std::uint8_t>(knows_blocked_[i] == 0);
            knows_blocked_[i] |= reached[i];
        }
    });
    exact_->find_blocked(cause_inputs(), reached, causes_);
}

scene::Image<std::uint8_t> LookupAnswers::reached_by(const scene::Image<float>& criticals,
                                                     const TapCriticals& taps,
                                                     float largest_bias) const
{
    scene::Image<std::uint8_t> reached{classes().size()};
    const auto is_asked = [&](std::size_t pixel) {
        return classes()[pixel] == PixelClass::blocked && knows_blocked_[pixel] == 0;
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
    return {lookup_.job.lookup,
            lookup_.job.shadow_map.resolution_texels,
            lookup_.view.frustum.reversed,
            exact_->receivers().truth(),
            lookup_.view.bias.normal_texels == 0 ? unbiased : lookup_.layers,
            unbiased,
            lookup_.map_depths,
            exact_->light()};
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
    return inputs;
}

std::vector<PanningGap> LookupAnswers::panning_gaps(const scene::Image<float>& critical,
                                                    float largest_bias)
{
    std::vector<std::size_t> panning;
    for (std::size_t i = 0; i < critical.pixel_count(); ++i) {
        if (classes()[i] == PixelClass::blocked && causes_.pixels[i].if_wrong == Cause::none &&
            critical[i] <= largest_bias) {
            panning.push_back(i);
        }
    }
    const auto lengths = exact_->pixel_gaps(panning);
    std::vector<PanningGap> gaps;
    gaps.reserve(panning.size());
    for (std::size_t i = 0; i < panning.size(); ++i) {
        gaps.push_back({critical[panning[i]], lengths[i]});
    }
    return gaps;
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
    const auto parts = count_parts(exact_->parts(), inputs, biases);
    const auto gaps = find_gaps_at(panning_gaps(curve.critical_bias, biases.back()), biases);
    for (const CurveQuestion::Row& row : question.rows) {
        const auto found = std::lower_bound(biases.begin(), biases.end(), row.bias);
        const auto i = static_cast<std::size_t>(found - biases.begin());
        const ErrorCounts& errors = counts[i].errors;
        finished.rows.push_back(
            {row.ordinal,
             {make_metrics(exact_->receivers().classes(),
                           {errors.false_shadow, errors.false_lit, errors_by[i]}),
              counts[i].causes, counts[i].amounts, gaps[i], parts[i]}});
    }
}

CurveResult LookupAnswers::describe_map() const
{
    CurveResult result;
    result.near_m = lookup_.view.frustum.near_m;
    result.far_m = lookup_.view.frustum.far_m;
    result.map_bytes = map_bytes(lookup_.job.shadow_map);
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
    const auto zeta_m = exact_->representative_zeta_m();
    if (curve.curve.lit().empty() || !zeta_m) {
        return std::nullopt;
    }
    const BiasPlace place{lookup_.view.frustum, lookup_.job.shadow_map.resolution_texels, *zeta_m};
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

scene::Image<float> LookupAnswers::critical_biases(float slope) const
{
    return analysis::critical_biases(deciding(), rule_with(slope));
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

void LookupAnswers::break_down(const scene::LookupLayers& own, int verdict_taps,
                               Diagnosis& diagnosis) const
{
    const scene::Image<float> no_criticals{diagnosis.biases ? scene::ImageSize{0, 0}
                                                            : classes().size(),
                                           std::numeric_limits<float>::quiet_NaN()};
    const BreakdownInputs inputs{classes(), own,
                                 diagnosis.biases ? diagnosis.biases->critical_bias : no_criticals,
                                 diagnosis.map_error_m, verdict_taps};
    diagnosis.by_distance = errors_by_bin(exact_->distances(), inputs);
    add_envelopes(diagnosis.by_distance, lookup_.view.frustum, lookup_.job.shadow_map.depth_format);
    diagnosis.by_angle = errors_by_bin(bin_by_angle(classes(), own), inputs);
    diagnosis.by_object = errors_by_object(classes(), own, exact_->receivers().receivers().triangle,
                                           exact_->triangles(), verdict_taps);
}

CauseLayers LookupAnswers::causes_of(const scene::LookupLayers& own, float constant, float slope)
{
    scene::Image<std::uint8_t> reached{classes().size()};
    for (std::size_t i = 0; i < reached.pixel_count(); ++i) {
        reached[i] =
            classes()[i] == PixelClass::blocked && double{own.samples[i].verdict} > partial_above;
    }
    find_blocked_causes(std::move(reached));
    require_lit_causes(constant, slope);
    const TapCriticals taps_of_slope = taps(slope);
    return classify_errors({classes(), own, criticals_of_verdicts(own), causes_, rule_with(slope),
                            has_texels() ? &taps_of_slope : nullptr, true},
                           constant);
}

void LookupAnswers::explain(const scene::LookupLayers& own, Diagnosis& diagnosis)
{
    const std::array<float, 1> bias{lookup_.view.bias.constant};
    const scene::Image<float> verdicts = criticals_of_verdicts(own);
    diagnosis.causes = causes_of(own, bias.front(), rule_.slope);
    const TapCriticals own_taps = taps(rule_.slope);
    const BiasRowInputs inputs{
        classes(), own, verdicts, causes_, rule_, has_texels() ? &own_taps : nullptr, true};
    diagnosis.parts = count_parts(exact_->parts(), inputs, bias).front();
    diagnosis.peter_panning = find_gaps_at(panning_gaps(verdicts, bias.front()), bias).front();
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

std::vector<MeasuredBias> LookupAnswers::measure_biases(float slope, std::span<const float> biases)
{
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
                            softening[i]});
    }
    return measured;
}

std::vector<ErrorAmounts> LookupAnswers::amounts_at(float slope,
                                                    std::span<const float> biases) const
{
    return has_taps() ? sum_amounts(classes(), taps(slope), biases)
                      : sum_amounts(BiasCurve{critical_biases(slope), classes()}, biases);
}

Diagnosis LookupAnswers::diagnose(const scene::LookupLayers& own, float profile_bias,
                                  int verdict_taps) &&
{
    Diagnosis diagnosis;
    explain(own, diagnosis);
    // What follows asks for neither, and takes the most memory.
    lookup_.unbiased = {};
    exact_->forget_texels();
    if (rule_.promises().has_curve()) {
        const SlopeInputs inputs = curves();
        SlopeCurve curve = slope_curve(inputs, lookup_.view.bias.slope);
        diagnosis.curve = describe(curve, profile_bias);
        diagnosis.biases = answer_biases({lookup_.job, lookup_.view, inputs, exact_->zeta_m(),
                                          exact_->representative_zeta_m().value_or(0)},
                                         std::move(curve), diagnosis.curve.recommended);
    }
    diagnosis.zeta_m = exact_->zeta_m();
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
