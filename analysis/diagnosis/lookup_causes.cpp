#include "analysis/diagnosis/lookup_causes.hpp"

#include "analysis/bias/amount_rows.hpp"
#include "analysis/causes/traced_lookups.hpp"
#include "analysis/lookup/taps.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/job_method.hpp"
#include "scene/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

namespace gnomon::analysis {

LookupCauses::LookupCauses(std::shared_ptr<LightQueryCache> exact, ObservedLookup lookup)
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

std::optional<scene::LookupTerms> LookupCauses::take_terms()
{
    return lookup_.terms ? std::optional{std::move(lookup_.terms->lookup)} : std::nullopt;
}

scene::LookupLayers LookupCauses::make_deciding() const
{
    return has_taps() ? deciding_samples({lookup_.layers.samples, {}, lookup_.layers.maps},
                                         lookup_.layers, lookup_.map_depths, rule_)
                      : scene::LookupLayers{};
}

PixelCauses LookupCauses::no_causes() const
{
    return {scene::Image<PixelCause>{classes().size()},
            scene::Image<FilterCause>{has_texels() ? classes().size() : scene::ImageSize{0, 0}}};
}

void LookupCauses::remove_bias()
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
    const auto all = static_cast<float>(rule_.traits.tap_count());
    for_each_run(lit_taps.pixel_count(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) {
            lookup_.layers.samples[i].verdict = static_cast<float>(lit_taps[i]) / all;
        }
    });
}

void LookupCauses::require_lit_causes(float smallest_bias, float slope)
{
    const bool below_zero = (smallest_bias < 0 || slope < 0) && has_texels();
    if (below_zero != knows_lit_below_zero_) {
        find_lit_causes(below_zero);
    }
}

void LookupCauses::find_lit_causes(bool below_zero)
{
    CauseInputs inputs = cause_inputs();
    inputs.asks_below_zero = below_zero;
    knows_lit_below_zero_ = below_zero;
    exact_->find_lit(inputs, causes_);
}

void LookupCauses::find_blocked_causes(scene::Image<std::uint8_t> reached)
{
    // Both are 0 or 1. Local pointers, since a byte might alias the image's own: otherwise this
    // pass is not vectorised.
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

scene::Image<std::uint8_t> LookupCauses::reached_by(const scene::Image<float>& criticals,
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

CauseInputs LookupCauses::cause_inputs() const
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

SlopeInputs LookupCauses::curves()
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

LookupRule LookupCauses::rule_with(float slope) const
{
    LookupRule rule = rule_;
    rule.slope = slope;
    return rule;
}

scene::Image<float> LookupCauses::critical_biases(float slope) const
{
    if (!has_curve()) {
        throw std::invalid_argument(
            "critical_biases: the lookup has no formula, and the renderers cannot find them");
    }
    return lookup_.reruns ? lookup_.reruns->find_critical_biases(slope)
                          : analysis::critical_biases(deciding(), rule_with(slope));
}

CauseLayers LookupCauses::causes_of(const scene::LookupLayers& own, float constant, float slope)
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

ExplainedVerdicts LookupCauses::explain(const scene::LookupLayers& own, float constant, float slope)
{
    const std::array<float, 1> bias{constant};
    const scene::Image<float> verdicts = criticals_of_verdicts(own);
    CauseLayers causes = causes_of(own, constant, slope);
    const TapCriticals own_taps = taps(slope);
    const BiasRowInputs inputs{
        classes(), own, verdicts, causes_, rule_with(slope), has_texels() ? &own_taps : nullptr,
        true};
    return {std::move(causes), gaps_at(verdicts, slope, bias).front(),
            count_error_buckets(exact_->cells(), inputs, bias).front()};
}

namespace {

/// Critical biases that reproduce whether verdicts are at least `lit_from`: −∞ or +∞.
scene::Image<float> criticals_of(const scene::Image<float>& verdicts, float lit_from)
{
    scene::Image<float> criticals{verdicts.size()};
    for (std::size_t i = 0; i < verdicts.pixel_count(); ++i) {
        criticals[i] = verdicts[i] >= lit_from ? -scene::infinity : scene::infinity;
    }
    return criticals;
}

/// Copies the results of lit pixels.
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

void LookupCauses::rerun_exactly()
{
    if (rule_.traits.compares_depths()) {
        return;
    }
    if (rule_.traits.compares == methods::Compares::primitives) {
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

ExactReruns LookupCauses::run_exactly(const renderers::ExactDepths& depths,
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
            "LookupCauses: the renderers cannot run the job's method over exact depths");
    }
    const auto verdicts = run.look_up(depths, std::span{&bias, 1}).front();
    return {criticals_of(verdicts, lit_from[0]), criticals_of(verdicts, lit_from[1]),
            criticals_of(verdicts, lit_from[2])};
}

} // namespace gnomon::analysis
