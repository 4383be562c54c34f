#include "analysis/tune_search.hpp"

#include "analysis/bias_reruns.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "analysis/ratio.hpp"
#include "scene/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The largest count whose rate does not exceed the limit.
std::uint64_t allowed(double max_rate, std::uint64_t denominator)
{
    const auto whole = static_cast<double>(denominator);
    auto count = static_cast<std::uint64_t>(std::clamp(max_rate, 0.0, 1.0) * whole);
    // The product rounds, and rates are quotients: the quotient decides.
    while (count < denominator && static_cast<double>(count + 1) / whole <= max_rate) {
        ++count;
    }
    while (count > 0 && static_cast<double>(count) / whole > max_rate) {
        --count;
    }
    return count;
}

bool meets(const std::optional<double>& rate, double limit)
{
    return !rate || *rate <= limit;
}

bool meets(const TunedSetting& setting, const TuneLimits& limits)
{
    return meets(setting.shadow_rate, limits.max_shadow_amount_rate) &&
           meets(setting.light_rate, limits.max_light_amount_rate) &&
           meets(setting.false_shadow_rate, limits.max_false_shadow_rate) &&
           meets(setting.false_lit_rate, limits.max_false_lit_rate);
}

/// Where biases are looked for: a recommendation does not push surfaces towards the light.
constexpr BiasInterval usable_biases{0.0F, 1.0F};

/// The biases that curves of fractions are tried at: 0, and 256 from 1e-7 to 1, 6.5 % apart.
std::vector<float> tried_biases()
{
    constexpr int count = 256;
    std::vector<float> biases{0.0F};
    for (int i = 0; i < count; ++i) {
        biases.push_back(static_cast<float>(std::pow(10.0, -7.0 + 7.0 * i / (count - 1))));
    }
    return biases;
}

/// The 64 of them around the least amount of error, softening included: with these causes are
/// asked for.
std::span<const float> around_least(const std::vector<float>& biases,
                                    const std::vector<ErrorAmounts>& amounts)
{
    constexpr std::ptrdiff_t most = 64;
    const auto least = std::ranges::min_element(amounts, {}, &ErrorAmounts::total);
    const std::ptrdiff_t last = std::ssize(biases) - most;
    const std::ptrdiff_t first = std::clamp(least - amounts.begin() - most / 2, std::ptrdiff_t{0},
                                            std::max(last, std::ptrdiff_t{0}));
    return std::span{biases}.subspan(static_cast<std::size_t>(first),
                                     static_cast<std::size_t>(std::min(most, std::ssize(biases))));
}

void set_measured(const Metrics& metrics, const CauseAmounts& amounts, TunedSetting& setting)
{
    setting.errors = {metrics.false_shadow, metrics.false_lit};
    setting.amounts = metrics.amounts;
    setting.shadow_softening = amounts.shadow_softening;
    setting.light_softening = amounts.light_softening;
    setting.false_shadow_rate = metrics.false_shadow_rate;
    setting.false_lit_rate = metrics.false_lit_rate;
    setting.error_rate = metrics.error_rate;
    setting.shadow_rate = ratio(metrics.amounts.shadow - amounts.shadow_softening,
                                metrics.pixels.of(scene::PixelClass::lit));
    setting.light_rate = ratio(metrics.amounts.light - amounts.light_softening,
                               metrics.pixels.of(scene::PixelClass::blocked));
}

} // namespace

BiasSearch::BiasSearch(const scene::Job& job, const scene::View& view, const JudgedView& judged,
                       const Renderers& renderers)
    : job_{job},
      view_{view},
      judged_{judged},
      renderers_{renderers}
{
    scene::LookupLayers lookup = renderers.look_up(job, view);
    if (!scene::promises(job.lookup.filter).has_fractions()) {
        const auto texels = lookup.texels;
        deciding_ = deciding_samples(std::move(lookup), texels, {}, lookup_rule(job, view));
        return;
    }
    if (!renderers.make_exact_light) {
        throw scene::InputError("lookup.filter: only the exact truth tells the borders that a "
                                "filter softens from errors; leave out --truth float");
    }
    auto receivers = std::make_shared<JudgedReceivers>(judged.receivers, judged.truth,
                                                       ReceiverUse{false, false});
    auto exact = std::make_shared<ExactLightCache>(judged.triangles, std::move(receivers), job,
                                                   view, renderers);
    answers_ = std::make_unique<LookupAnswers>(
        std::move(exact), observe_lookup(job, view, std::move(lookup), renderers));
}

void BiasSearch::find_constant(const TuneLimits& limits, TunedSetting& setting) const
{
    if (answers_ != nullptr) {
        search_fractions(limits, setting);
    } else {
        search_curve(limits, setting);
    }
}

double BiasSearch::softening_of(const scene::LookupLayers& own, const scene::Bias& bias) const
{
    return answers_ == nullptr
               ? 0.0
               : answers_->causes_of(own, bias.constant, bias.slope).amounts.softening();
}

/// Verdicts are no fractions: amounts are counts.
void BiasSearch::search_curve(const TuneLimits& limits, TunedSetting& setting) const
{
    LookupRule rule = lookup_rule(job_, view_);
    rule.slope = static_cast<float>(setting.slope);
    const BiasCurve curve{critical_biases(deciding_, rule), judged_.truth.pixel_class};
    const ErrorCounts most{
        allowed(std::min(limits.max_shadow_amount_rate, limits.max_false_shadow_rate),
                curve.lit().size()),
        allowed(std::min(limits.max_light_amount_rate, limits.max_false_lit_rate),
                curve.blocked().size())};
    BiasInterval within = usable_biases;
    if (const auto meeting = biases_with_at_most(curve, most)) {
        const BiasInterval both{std::max(meeting->lo, usable_biases.lo),
                                std::min(meeting->hi, usable_biases.hi)};
        setting.meets_limits = both.lo <= both.hi;
        within = setting.meets_limits ? both : usable_biases;
    }
    const BestBiases best = find_best_biases(curve, within);
    setting.interval = best.interval;
    setting.constant = best.recommended();
    const std::array<float, 1> constant{setting.constant};
    const ErrorCounts errors = curve.at(setting.constant);
    set_measured(make_metrics(count_classes(judged_.truth), {errors.false_shadow, errors.false_lit,
                                                             sum_amounts(curve, constant).front()}),
                 {}, setting);
}

void BiasSearch::search_fractions(const TuneLimits& limits, TunedSetting& setting) const
{
    const auto slope = static_cast<float>(setting.slope);
    const auto measured = scene::promises(job_.lookup.filter).has_curve() ? measured_on_curve(slope)
                                                                          : measured_by_gl(slope);
    std::vector<TunedSetting> tried;
    for (const MeasuredBias& at : measured) {
        TunedSetting& one = tried.emplace_back(setting);
        one.constant = at.bias;
        set_measured(at.metrics, at.amounts, one);
        one.meets_limits = meets(one, limits);
    }
    const auto is_as_good = [](const TunedSetting& a, const TunedSetting& b) {
        return a.meets_limits == b.meets_limits && a.error_amount() == b.error_amount();
    };
    const auto best = std::min_element(
        tried.begin(), tried.end(),
        [](const TunedSetting& a, const TunedSetting& b) { return is_better(a, b); });
    const auto end = std::find_if_not(
        best, tried.end(), [&](const TunedSetting& other) { return is_as_good(*best, other); });
    const BiasInterval interval{best->constant, std::prev(end)->constant};
    setting = *(best + (end - best) / 2);
    setting.interval = interval;
}

std::vector<MeasuredBias> BiasSearch::measured_on_curve(float slope) const
{
    const std::vector<float> biases = tried_biases();
    return answers_->measure_biases(slope,
                                    around_least(biases, answers_->amounts_at(slope, biases)));
}

std::vector<MeasuredBias> BiasSearch::measured_by_gl(float slope) const
{
    scene::View view = view_;
    view.bias.slope = slope;
    std::vector<MeasuredBias> measured;
    for (const float bias : rerun_list()) {
        view.bias.constant = bias;
        const scene::LookupLayers own = renderers_.look_up(job_, view);
        measured.push_back(
            {bias, measure(judged_.truth, own, scene::promises(job_.lookup.filter).equal_taps()),
             answers_->causes_of(own, bias, slope).amounts});
    }
    return measured;
}

} // namespace gnomon::analysis
