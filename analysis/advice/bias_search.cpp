#include "analysis/advice/bias_search.hpp"

#include "analysis/bias/amount_rows.hpp"
#include "analysis/bias/bias_units.hpp"
#include "analysis/lookup/taps.hpp"
#include "analysis/pixels/maps_of_pixels.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/infinity.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace gnomon::analysis {

namespace {

constexpr float largest_bias = std::numeric_limits<float>::max();

/// Rounds to a valid bias, which is neither subnormal nor infinite.
float as_bias(double bias)
{
    if (bias >= double{largest_bias}) {
        return largest_bias;
    }
    const auto rounded = static_cast<float>(bias);
    return std::isnormal(rounded) ? rounded : 0.0F;
}

std::optional<BiasInterval> common(const BiasInterval& a, const BiasInterval& b)
{
    const BiasInterval both{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
    return both.lo <= both.hi ? std::optional{both} : std::nullopt;
}

/// Merges ascending lists.
std::vector<float> merged(std::vector<float> a, const std::vector<float>& b)
{
    const auto middle = static_cast<std::ptrdiff_t>(a.size());
    a.insert(a.end(), b.begin(), b.end());
    std::inplace_merge(a.begin(), a.begin() + middle, a.end());
    return a;
}

bool is_same_map(const scene::Job& a, const scene::View& view_a, const scene::Job& b,
                 const scene::View& view_b)
{
    const auto draws_alike = [](const scene::LightFrustum& one, const scene::LightFrustum& other) {
        return one.light_clip_from_world == other.light_clip_from_world &&
               one.reversed == other.reversed && one.clip_range == other.clip_range;
    };
    return std::ranges::equal(view_a.maps, view_b.maps, draws_alike) &&
           a.shadow_map.resolution_texels == b.shadow_map.resolution_texels &&
           a.shadow_map.depth_format == b.shadow_map.depth_format &&
           a.shadow_map.cull == b.shadow_map.cull && a.method == b.method;
}

/// Intervals of neighbouring biases at which all outcomes meet the limits.
std::vector<BiasInterval> meeting_runs(std::span<const float> biases,
                                       const std::vector<bool>& meets_at)
{
    std::vector<BiasInterval> runs;
    for (std::size_t i = 0; i < biases.size(); ++i) {
        if (meets_at[i] && i > 0 && meets_at[i - 1]) {
            runs.back().hi = biases[i];
        } else if (meets_at[i]) {
            runs.push_back({biases[i], biases[i]});
        }
    }
    return runs;
}

} // namespace

BiasSearch::BiasSearch(const scene::SceneFile& file, const Renderers& renderers, bool in_metres)
    : file_{file},
      renderers_{renderers},
      in_metres_{in_metres}
{
}

bool BiasSearch::has_formula() const
{
    return methods::traits(views_.front().job).has_formula();
}

bool BiasSearch::has_curve() const
{
    return methods::traits(views_.front().job).has_curve();
}

bool BiasSearch::has_fractions() const
{
    return methods::traits(views_.front().job).has_fractions();
}

const renderers::Drawn& BiasSearch::drawn(std::size_t view) const
{
    if (drawn_view_ == view) {
        return drawn_;
    }
    const SearchedView& now = views_[view];
    const bool has_map = drawn_view_ && is_same_map(views_[*drawn_view_].job,
                                                    views_[*drawn_view_].view, now.job, now.view);
    drawn_view_.reset();
    drawn_.receivers.reset(); // frees memory for the others
    drawn_.receivers = renderers_.rasterizer.draw_receivers(now.view);
    if (!has_map) {
        drawn_.map.reset();
        drawn_.map = renderers::draw_filtered_map(renderers_.rasterizer, now.job, now.view);
    }
    drawn_view_ = view;
    return drawn_;
}

scene::LookupLayers BiasSearch::look_up(std::size_t view, const scene::View& biased) const
{
    return renderers_.rasterizer.look_up({drawn(view), views_[view].job, biased});
}

ObservedLookup BiasSearch::observe(std::size_t view, const scene::View& biased,
                                   scene::LookupLayers own) const
{
    return observe_lookup(
        views_[view].job, biased, file_.scene, std::move(own), [this, view] { return drawn(view); },
        renderers_.rasterizer);
}

scene::BiasSettings BiasSearch::shared_bias_settings(const scene::Job& job) const
{
    scene::BiasSettings settings = job.bias;
    const bool is_directional =
        !scene::is_positional(scene::resolve_light(job, file_.defaults).type);
    if (in_metres_ && is_directional && scene::bias_unit_of(settings).is_depth()) {
        scene::set_constant(settings, scene::bias_in_metres, 0);
    }
    return settings;
}

void BiasSearch::add_view(const scene::Job& job, const CheckedView& checked)
{
    SearchedView& added = views_.emplace_back();
    added.job = job;
    added.job.bias = {.normal_texels = job.bias.normal_texels};
    if (views_.size() == 1) {
        bias_settings_ = shared_bias_settings(job);
    }
    scene::set_constant(added.job, scene::bias_unit_of(bias_settings_), 0, 0);
    added.view = scene::resolve_view(added.job, file_.scene, file_.defaults);
    added.set_constant = scene::resolve_bias(job.bias, added.view.first_map()).constant;
    added.set_scales = scene::scales_bias(job) ? added.view.bias_scales : std::vector<float>{};
    added.checked = &checked;
    const std::size_t view = views_.size() - 1;
    scene::LookupLayers lookup = look_up(view, added.view);
    added.read_map = most_read_map(lookup.maps, checked.truth.pixel_class);
    if (counts_errors()) {
        added.deciding =
            deciding_samples(std::move(lookup), {}, {}, lookup_rule(added.job, added.view));
        return;
    }
    if (!has_curve() && !has_fractions()) {
        return; // nothing is softened, since amounts equal counts
    }
    if (!renderers_.reference.has_light_queries()) {
        throw scene::InputError("lookup.filter: telling softened borders from errors needs the "
                                "exact truth; leave out --truth float");
    }
    auto receivers = std::make_shared<ScoredReceivers>(checked.receivers, checked.truth,
                                                       ReceiverUse{false, false});
    auto exact = std::make_shared<LightQueryCache>(file_.scene, std::move(receivers), added.job,
                                                   added.view, renderers_.reference);
    if (!has_curve()) {
        added.exact = std::move(exact);
        return;
    }
    added.answers = std::make_unique<LookupAnswers>(std::move(exact),
                                                    observe(view, added.view, std::move(lookup)));
}

BiasLengths BiasSearch::lengths() const
{
    const SearchedView& own = views_.front();
    return bias_lengths_in(own.view, own.job.shadow_map.resolution_texels,
                           own.checked->median_light_distance_m, own.read_map);
}

float BiasSearch::converted(std::size_t to, float bias) const
{
    if (!shares_metres() || to == 0 || !(bias > 0)) {
        return bias;
    }
    const SearchedView& own = views_.front();
    const double length_m =
        bias_length_m(own.view.first_map(), double{bias}, own.checked->median_light_distance_m);
    return as_bias(bias_of_length(views_[to].view.first_map(), length_m,
                                  views_[to].checked->median_light_distance_m));
}

float BiasSearch::converted_back(std::size_t from, float bias) const
{
    if (!shares_metres() || from == 0 || !(bias > 0) || std::isinf(bias)) {
        return bias;
    }
    const SearchedView& own = views_.front();
    const double length_m = bias_length_m(views_[from].view.first_map(), double{bias},
                                          views_[from].checked->median_light_distance_m);
    return as_bias(
        bias_of_length(own.view.first_map(), length_m, own.checked->median_light_distance_m));
}

std::vector<BiasCurve> BiasSearch::curves(float slope) const
{
    std::vector<BiasCurve> all;
    for (const SearchedView& view : views_) {
        LookupRule rule = lookup_rule(view.job, view.view);
        rule.slope = slope;
        all.emplace_back(critical_biases(view.deciding, rule), view.checked->truth.pixel_class);
    }
    return all;
}

BiasSearch::ViewsMinimum BiasSearch::minimum_of(const std::vector<BiasCurve>& curves,
                                                const TuneLimits& limits) const
{
    std::vector<float> lit;
    std::vector<float> blocked;
    std::optional<BiasInterval> allowed = BiasInterval{0.0F, scene::infinity};
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto back = [&](std::vector<float> criticals) {
            std::ranges::transform(criticals, criticals.begin(),
                                   [&](float critical) { return converted_back(i, critical); });
            return criticals;
        };
        lit = merged(std::move(lit), back(curves[i].lit()));
        blocked = merged(std::move(blocked), back(curves[i].blocked()));
        const auto here = biases_within(curves[i], limits);
        allowed = here && allowed
                      ? common(*allowed, {converted_back(i, here->lo), converted_back(i, here->hi)})
                      : std::nullopt;
    }
    ViewsMinimum found{find_broad_minimum(error_pieces(lit, blocked)), {}};
    if (allowed) {
        found.allowed.push_back(*allowed);
    }
    return found;
}

std::vector<float> BiasSearch::converted(std::size_t to, std::span<const float> biases) const
{
    std::vector<float> here;
    for (const float bias : biases) {
        here.push_back(converted(to, bias));
    }
    return here;
}

SampledCurve BiasSearch::sampled_curve(float slope, OutcomesByBias& kept) const
{
    return {
        [this, slope](std::span<const float> biases) { return pooled_amounts(slope, biases); },
        [this, slope, &kept](std::span<const float> biases) {
            for (std::size_t view = 0; view < views_.size(); ++view) {
                const auto outcomes = outcomes_in(view, slope, biases);
                for (std::size_t i = 0; i < biases.size(); ++i) {
                    kept[biases[i]].resize(views_.size());
                    kept[biases[i]][view] = outcomes[i];
                }
            }
            std::vector<SoftAmounts> sums;
            for (const float bias : biases) {
                const ViewOutcome all = pooled(kept.at(bias));
                sums.push_back({all.metrics.amounts, {all.shadow_softening, all.light_softening}});
            }
            return sums;
        }};
}

BiasSearch::ViewsMinimum BiasSearch::minimum_of_fractions(const TuneLimits& limits, float slope,
                                                          BiasSteps steps) const
{
    OutcomesByBias outcomes;
    const SampledCurve curve = sampled_curve(slope, outcomes);
    SampledMinimum found;
    if (scene::has_key(views_.front().job, "bias.constant")) {
        found = search_broad_minimum(curve, has_curve() ? steps : BiasSteps::coarse);
    } else {
        const std::array<float, 1> none{0.0F};
        found.pieces.push_back({0, 0, curve.measure(none).front().amounts.total()});
        found.broad_minimum = find_broad_minimum(found.pieces);
    }
    std::vector<float> biases;
    std::vector<bool> meets_at;
    for (const ErrorPiece& piece : found.pieces) {
        biases.push_back(piece.lo);
        meets_at.push_back(std::ranges::all_of(
            outcomes.at(piece.lo), [&](const ViewOutcome& of) { return meets(of, limits); }));
    }
    return {found.broad_minimum, meeting_runs(biases, meets_at)};
}

RecommendedBias BiasSearch::recommended_of(const ViewsMinimum& found) const
{
    if (!found.broad_minimum) {
        return {};
    }
    const RecommendedBias recommended = recommended_bias(found.broad_minimum->run, lengths());
    const float allowed = allowed_bias(found.broad_minimum->run, recommended.bias, found.allowed)
                              .value_or(recommended.bias);
    return allowed == recommended.bias ? recommended
                                       : RecommendedBias{allowed, Margin::within_limits};
}

RoundedBias BiasSearch::rounded_of(const ViewsMinimum& found,
                                   const RecommendedBias& recommended) const
{
    const BiasInterval broad_minimum =
        found.broad_minimum ? found.broad_minimum->run : BiasInterval{};
    BiasInterval within = broad_minimum;
    for (const BiasInterval& allowed : found.allowed) {
        if (allowed.lo <= recommended.bias && recommended.bias <= allowed.hi) {
            within = common(within, allowed).value_or(allowed);
        }
    }
    return rounded_near(recommended, broad_minimum, within, bias_settings_, own_view().first_map());
}

FoundBias BiasSearch::find(const TuneLimits& limits, float slope, BiasSteps steps) const
{
    const bool is_counted = counts_errors();
    const std::vector<BiasCurve> of_views = is_counted ? curves(slope) : std::vector<BiasCurve>{};
    const ViewsMinimum broad_minimum =
        is_counted ? minimum_of(of_views, limits) : minimum_of_fractions(limits, slope, steps);
    const RecommendedBias recommended = recommended_of(broad_minimum);
    FoundBias found;
    found.run = broad_minimum.broad_minimum ? broad_minimum.broad_minimum->run : BiasInterval{};
    found.recommended = recommended;
    found.rounded = rounded_of(broad_minimum, recommended);
    found.meets_limits = true;
    found.length = lengths().of(found.rounded.bias);
    found.low = lengths().of(found.run.lo);
    found.high = lengths().of(found.run.hi);
    const std::array<float, 1> constant{found.rounded.bias};
    for (std::size_t view = 0; view < views_.size(); ++view) {
        if (!is_counted) {
            found.outcomes.push_back(outcomes_in(view, slope, constant).front());
        } else {
            const float here = converted(view, constant.front());
            const ErrorCounts errors = of_views[view].at(here);
            found.outcomes.push_back(
                {here,
                 make_metrics(views_[view].checked->pixels,
                              {errors.false_shadow, errors.false_lit,
                               sum_amounts(of_views[view], std::array{here}).front()}),
                 0, 0});
        }
        found.meets_limits = found.meets_limits && meets(found.outcomes.back(), limits);
    }
    return found;
}

} // namespace gnomon::analysis
