#include "analysis/answers/diagnose.hpp"

#include "analysis/answers/exact_light_cache.hpp"
#include "analysis/answers/judged_receivers.hpp"
#include "analysis/answers/lookup_answers.hpp"
#include "analysis/answers/mapless_diagnosis.hpp"
#include "methods/job_method.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace gnomon::analysis {

std::optional<Softening> softening_without_constant(const scene::Job& job, scene::View view,
                                                    const scene::TriangleScene& triangles,
                                                    const std::shared_ptr<ExactLightCache>& exact,
                                                    const Renderers& renderers)
{
    view.bias.constant = 0;
    const scene::LookupLayers own = renderers.look_up(job, view);
    if (own.samples.size() != view.image) {
        return std::nullopt; // another renderer's, that recorded no such lookup
    }
    LookupAnswers answers{exact, observe_lookup(job, view, triangles, own, renderers)};
    const CauseAmounts amounts = answers.causes_of(own, 0, view.bias.slope).amounts;
    return Softening{amounts.shadow_softening, amounts.light_softening};
}

Diagnosis diagnose(const scene::Job& job, const scene::View& view, const ComparedLayers& layers,
                   const DiagnosisRequest& request, const Renderers& renderers)
{
    if (!methods::promises(job).has_map) {
        return diagnose_without_map(job, view, layers, renderers);
    }
    auto receivers = std::make_shared<JudgedReceivers>(
        layers.receivers, layers.truth, ReceiverUse{.by_many_maps = false, .counts_cells = true});
    ObservedLookup lookup = observe_lookup(job, view, layers.triangles, layers.lookup, renderers);
    const bool gives_map_back =
        request.map == MapAfterDiagnosis::given_back && renderers.forget_shadow_map;
    const bool asks_map = lookup.reruns || lookup.exact_run;
    if (gives_map_back && !asks_map) {
        renderers.forget_shadow_map(); // before what takes the most memory
    }
    auto exact = std::make_shared<ExactLightCache>(layers.triangles, std::move(receivers), job,
                                                   view, renderers);
    LookupAnswers answers{exact, std::move(lookup)};
    std::optional<Softening> at_zero;
    if (!answers.has_curve() && methods::promises(job).has_fractions() && view.bias.constant != 0) {
        at_zero = softening_without_constant(job, view, layers.triangles, exact, renderers);
    }
    Diagnosis found = std::move(answers).diagnose(layers.lookup, request, layers.verdict_taps);
    if (at_zero) {
        found.curve.softening_at_zero = at_zero;
    }
    if (gives_map_back && asks_map) {
        renderers.forget_shadow_map();
    }
    return found;
}

} // namespace gnomon::analysis
