// What must be known of a lookup beside its layers, asked of the renderers.

#include "analysis/answers/lookup_answers.hpp"
#include "analysis/lookup/deciding_samples.hpp"
#include "methods/job_method.hpp"

#include <span>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

LookupReruns reruns_of(const scene::Job& job, const scene::View& view, const Renderers& renderers)
{
    const auto with = [view](float constant, float slope) {
        scene::View biased = view;
        biased.bias.constant = constant;
        biased.bias.slope = slope;
        return biased;
    };
    return {[with, job, &renderers](float constant, float slope) {
                return renderers.look_up(job, with(constant, slope));
            },
            [with, job, &renderers](float slope) {
                return renderers.find_critical_biases(job, with(0, slope));
            }};
}

ExactRun exact_run_of(const scene::Job& job, const scene::View& view, const Renderers& renderers)
{
    const methods::Promises promised = methods::promises(job);
    ExactRun run;
    if (promised.has_curve() && renderers.find_exact_critical_biases) {
        run.find_critical_biases = [job, view, &renderers](const ExactDepths& depths,
                                                           const scene::Bias& other,
                                                           std::span<const float> lit_from) {
            scene::View placed = view;
            placed.bias = other;
            auto criticals = renderers.find_exact_critical_biases(job, placed, depths, lit_from);
            renderers.draw_map(job, view);
            return criticals;
        };
    }
    if (renderers.look_up_exactly) {
        run.look_up = [job, view, &renderers](const ExactDepths& depths,
                                              std::span<const scene::Bias> biases) {
            auto verdicts = renderers.look_up_exactly(job, view, depths, biases);
            renderers.draw_map(job, view);
            return verdicts;
        };
    }
    if (promised.samples > 1) {
        run.places = renderers.sample_places(promised.samples);
    }
    run.layers = promised.layers;
    return run;
}

} // namespace

ObservedLookup observe_lookup(const scene::Job& job, const scene::View& view,
                              const scene::TriangleScene& triangles, scene::LookupLayers layers,
                              const Renderers& renderers)
{
    ObservedLookup lookup{job, view, std::move(layers)};
    const methods::Promises promised = methods::promises(job);
    if (!can_derive_unbiased(job, view)) {
        scene::View unbiased = view;
        unbiased.bias = {};
        const bool is_offset = methods::map_offset(job, view).has_value();
        if (is_offset) {
            renderers.draw_map(job, unbiased);
        }
        lookup.unbiased = renderers.look_up(job, unbiased);
        if (is_offset && !promised.has_one_tap()) {
            lookup.unbiased_map_depths = renderers.read_map_depths();
        }
        lookup.terms = find_kept_terms(job, view, triangles, renderers);
        if (is_offset) {
            renderers.draw_map(job, view);
        }
    }
    if (!promised.has_one_tap()) {
        lookup.map_depths = renderers.read_map_depths();
    }
    if (promised.has_curve() && !promised.has_formula() && renderers.find_critical_biases) {
        lookup.reruns = reruns_of(job, view, renderers);
    }
    if (!promised.has_exact_causes()) {
        lookup.exact_run = exact_run_of(job, view, renderers);
    }
    return lookup;
}

} // namespace gnomon::analysis
