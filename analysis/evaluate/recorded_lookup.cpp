#include "analysis/evaluate/case_causes.hpp"

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/taps.hpp"
#include "analysis/pixels/pixel_runs.hpp"
#include "methods/job_method.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Calls `visit(pixel, taps)` for every pixel that shows something, on several threads.
template <typename Visit>
void visit_pixels(const scene::CaseLayers& layers, const scene::LookupLayers& lookup,
                  const LookupRule& rule, const Visit& visit)
{
    const TapCriticals taps{lookup, layers.map_depths, rule};
    for_each_run(lookup.samples.pixel_count(), [&](std::size_t first, std::size_t last) {
        std::vector<double> weights(taps.taps_each());
        std::vector<WeighedCritical> weighed(taps.taps_each());
        const auto is_seen = [&](std::size_t pixel) {
            return !std::isnan(layers.position[pixel].x);
        };
        taps.visit(first, last, is_seen, [&](std::size_t pixel, std::span<const float> criticals) {
            taps.weights(pixel, weights);
            for (std::size_t t = 0; t < weighed.size(); ++t) {
                weighed[t] = {criticals[t], weights[t]};
            }
            visit(pixel, weighed);
        });
    });
}

/// Repeats a case's lookups with other constant and slope biases. It compares each tap of the
/// recorded receivers, places and map in float32, as `LookupRule` does, and counts it by its exact
/// weight, which a driver rounds. It draws nothing, so it cannot try other settings.
class RecordedLookup {
public:
    /// @param layers  With r, places and the map (`missing_for_causes`); must outlive this.
    explicit RecordedLookup(const scene::CaseLayers& layers) : layers_{layers} {}

    /// Whether the job's verdicts follow from comparisons with the map's texels.
    [[nodiscard]] bool answers(const scene::Job& job) const;

    /// Without any bias it returns the case's own record, if there is one.
    [[nodiscard]] scene::LookupLayers look_up(const scene::Job& job, const scene::View& view) const;

    /// The smallest constant bias of each pixel with which `look_up` lights it.
    [[nodiscard]] scene::Image<float> find_critical_biases(const scene::Job& job,
                                                           const scene::View& view) const;

private:
    const scene::CaseLayers& layers_;
};

bool RecordedLookup::answers(const scene::Job& job) const
{
    return methods::traits(job).is_made_of_taps() && !layers_.map_depths.empty();
}

scene::LookupLayers RecordedLookup::look_up(const scene::Job& job, const scene::View& view) const
{
    // An offset along the normal moves lookups.
    const bool is_unbiased =
        view.bias.constant == 0 && view.bias.slope == 0 && !methods::moves_lookups(job, view);
    if (is_unbiased && !layers_.unmoved.samples.empty()) {
        return layers_.unmoved;
    }
    scene::LookupLayers lookup = recorded_lookup(layers_, true);
    visit_pixels(layers_, lookup, lookup_rule(job, view),
                 [&](std::size_t pixel, const std::vector<WeighedCritical>& taps) {
                     double lit = 0;
                     double all = 0;
                     for (const auto& [critical, weight] : taps) {
                         lit += critical <= view.bias.constant ? weight : 0;
                         all += weight;
                     }
                     lookup.samples[pixel].verdict = static_cast<float>(lit / all);
                 });
    return lookup;
}

scene::Image<float> RecordedLookup::find_critical_biases(const scene::Job& job,
                                                         const scene::View& view) const
{
    const scene::LookupLayers lookup = recorded_lookup(layers_, true);
    scene::Image<float> criticals{layers_.size()};
    visit_pixels(layers_, lookup, lookup_rule(job, view),
                 [&](std::size_t pixel, std::vector<WeighedCritical>& taps) {
                     criticals[pixel] = smallest_lit_bias(
                         taps, [](double lit, double all) { return lit >= 0.5 * all; });
                 });
    return criticals;
}

} // namespace

scene::LookupLayers recorded_lookup(const scene::CaseLayers& layers, bool has_maps)
{
    scene::LookupLayers lookup{scene::Image<scene::LookupSample>{layers.size()}, layers.texels,
                               has_maps ? layers.maps : scene::MapIndices{}};
    lookup.kernel_axes = layers.kernel_axes;
    for (std::size_t i = 0; i < lookup.samples.pixel_count(); ++i) {
        lookup.samples[i] = {layers.z_light.empty() ? 0.0F : layers.z_light[i],
                             layers.z_map.empty() ? 0.0F : layers.z_map[i],
                             layers.tan_theta.empty() ? 0.0F : layers.tan_theta[i], layers.mask[i]};
    }
    return lookup;
}

ObservedLookup observe_recorded(const scene::CaseLayers& layers, const scene::Job& job,
                                const scene::View& view, scene::LookupLayers own)
{
    const methods::LookupTraits traits = methods::traits(job);
    const RecordedLookup recorded{layers};
    const bool answers = recorded.answers(job);
    const auto with = [view](float constant, float slope) {
        scene::View biased = view;
        biased.bias.constant = constant;
        biased.bias.slope = slope;
        return biased;
    };
    const auto look_up = [=, &layers](const scene::View& biased) {
        return answers ? recorded.look_up(job, biased) : layers.unmoved;
    };
    ObservedLookup lookup{job, view, std::move(own)};
    if (!can_derive_unbiased(job, view)) {
        scene::View unbiased = view;
        unbiased.bias = {};
        lookup.unbiased = look_up(unbiased);
        if (!layers.terms.moved.empty()) {
            lookup.terms = make_kept_terms(job, view, layers.terms, std::nullopt);
        }
    }
    if (!traits.has_one_tap()) {
        lookup.map_depths = layers.map_depths;
    }
    if (answers && traits.has_curve() && !traits.has_formula()) {
        lookup.reruns = {
            [=](float constant, float slope) { return look_up(with(constant, slope)); },
            [=](float slope) { return recorded.find_critical_biases(job, with(0, slope)); }};
    }
    const bool has_curve = traits.has_formula() || lookup.reruns;
    if (!has_curve && traits.has_fractions() && view.bias.constant != 0) {
        const scene::View at_zero = with(0, view.bias.slope);
        if (scene::LookupLayers unbiased = look_up(at_zero); !unbiased.samples.empty()) {
            lookup.without_constant = [=, &layers] {
                return observe_recorded(layers, job, at_zero, unbiased);
            };
        }
    }
    return lookup;
}

} // namespace gnomon::analysis
