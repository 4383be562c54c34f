// Gathers from the rasterizer what is needed of a lookup besides its layers.

#include "analysis/diagnosis/observe_lookup.hpp"
#include "analysis/lookup/taps.hpp"
#include "methods/job_method.hpp"

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// A job's lookups, which can be repeated.
struct AskedLookup {
    scene::Job job;
    scene::View view;
    DrawnSource drawn;
    renderers::Rasterizer& rasterizer;

    [[nodiscard]] scene::View with(float constant, float slope) const
    {
        scene::View biased = view;
        biased.bias.constant = constant;
        biased.bias.slope = slope;
        return biased;
    }
};

LookupReruns reruns_of(const std::shared_ptr<const AskedLookup>& asked)
{
    return {[asked](float constant, float slope) {
                return asked->rasterizer.look_up(
                    {asked->drawn(), asked->job, asked->with(constant, slope)});
            },
            [asked](float slope) {
                return asked->rasterizer.find_critical_biases(
                    {asked->drawn(), asked->job, asked->with(0, slope)}, 0.5F);
            }};
}

/// Lookups in a map of exact depths.
class ExactLookups {
public:
    ExactLookups(const AskedLookup& asked, const renderers::ExactDepths& depths)
        : asked_{asked},
          drawn_{asked.drawn().receivers,
                 asked.rasterizer.store_map(asked.job, asked.view, depths)},
          depths_{&depths.receivers,
                  depths.next_receivers.empty() ? nullptr : &depths.next_receivers}
    {
    }

    [[nodiscard]] scene::Image<float> find_critical_biases(scene::Bias other, float lit_from) const
    {
        other.constant = 0;
        other.slope = 0;
        const scene::View placed = with(other);
        return asked_.rasterizer.find_critical_biases({drawn_, asked_.job, placed, depths_},
                                                      lit_from);
    }
    [[nodiscard]] scene::Image<float> verdicts(const scene::Bias& bias) const
    {
        const scene::View biased = with(bias);
        const auto samples =
            asked_.rasterizer.look_up({drawn_, asked_.job, biased, depths_}).samples;
        scene::Image<float> verdicts{samples.size()};
        for (std::size_t i = 0; i < samples.pixel_count(); ++i) {
            verdicts[i] = samples[i].verdict;
        }
        return verdicts;
    }

private:
    [[nodiscard]] scene::View with(const scene::Bias& bias) const
    {
        scene::View view = asked_.view;
        view.bias = bias;
        return view;
    }

    const AskedLookup& asked_;
    renderers::Drawn drawn_;
    renderers::ReceiverDepths depths_;
};

ExactRun exact_run_of(const std::shared_ptr<const AskedLookup>& asked)
{
    const methods::LookupTraits traits = methods::traits(asked->job);
    ExactRun run;
    if (traits.has_curve()) {
        run.find_critical_biases = [asked](const renderers::ExactDepths& depths,
                                           const scene::Bias& other,
                                           std::span<const float> lit_from) {
            const ExactLookups lookups{*asked, depths};
            std::vector<scene::Image<float>> criticals;
            for (const float least : lit_from) {
                criticals.push_back(lookups.find_critical_biases(other, least));
            }
            return criticals;
        };
    }
    run.look_up = [asked](const renderers::ExactDepths& depths,
                          std::span<const scene::Bias> biases) {
        const ExactLookups lookups{*asked, depths};
        std::vector<scene::Image<float>> verdicts;
        for (const scene::Bias& bias : biases) {
            verdicts.push_back(lookups.verdicts(bias));
        }
        return verdicts;
    };
    if (traits.samples > 1) {
        run.places = asked->rasterizer.sample_places(traits.samples);
    }
    run.layers = traits.layers;
    return run;
}

/// Observes the unbiased lookup, if it cannot be derived, and the effect of the bias terms.
void observe_unbiased(const renderers::Drawn& drawn, const scene::TriangleScene& triangles,
                      renderers::Rasterizer& rasterizer, ObservedLookup& lookup)
{
    const scene::Job& job = lookup.job;
    scene::View unbiased = lookup.view;
    unbiased.bias = {};
    const bool is_offset = methods::map_offset(job, lookup.view).has_value();
    renderers::Drawn without_offset = drawn;
    if (is_offset) {
        without_offset.map = renderers::draw_filtered_map(rasterizer, job, unbiased);
    }
    lookup.unbiased = rasterizer.look_up({without_offset, job, unbiased});
    if (is_offset && !methods::traits(job).has_one_tap()) {
        lookup.unbiased_map_depths = without_offset.map->map().depths();
    }
    without_offset = {}; // before more maps are drawn
    lookup.terms = find_kept_terms(job, lookup.view, triangles, drawn, rasterizer);
}

} // namespace

ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                              const scene::TriangleScene& triangles, scene::LookupLayers layers,
                              const DrawnSource& drawn, renderers::Rasterizer& rasterizer)
{
    ObservedLookup lookup{job, view, std::move(layers)};
    const methods::LookupTraits traits = methods::traits(job);
    if (!can_derive_unbiased(job, view)) {
        observe_unbiased(drawn(), triangles, rasterizer, lookup);
    }
    if (!traits.has_one_tap()) {
        lookup.map_depths = drawn().map->map().depths();
    }
    const auto asked =
        std::make_shared<const AskedLookup>(AskedLookup{job, view, drawn, rasterizer});
    if (traits.has_curve() && !traits.has_formula()) {
        lookup.reruns = reruns_of(asked);
    }
    if (!traits.has_exact_causes()) {
        lookup.exact_run = exact_run_of(asked);
    }
    if (!traits.has_curve() && traits.has_fractions() && view.bias.constant != 0) {
        lookup.without_constant = [asked, &triangles] {
            const scene::View at_zero = asked->with(0, asked->view.bias.slope);
            return observe_lookup(asked->job, at_zero, triangles,
                                  asked->rasterizer.look_up({asked->drawn(), asked->job, at_zero}),
                                  asked->drawn, asked->rasterizer);
        };
    }
    return lookup;
}

} // namespace gnomon::analysis
