#include "analysis/answers/diagnosis.hpp"

#include "analysis/answers/exact_light_cache.hpp"
#include "analysis/answers/judged_receivers.hpp"
#include "analysis/answers/lookup_answers.hpp"
#include "analysis/answers/mapless_diagnosis.hpp"
#include "methods/list.hpp"

#include <memory>
#include <utility>

namespace gnomon::analysis {

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
    LookupAnswers answers{std::make_shared<ExactLightCache>(layers.triangles, std::move(receivers),
                                                            job, view, renderers),
                          std::move(lookup)};
    Diagnosis found = std::move(answers).diagnose(layers.lookup, request, layers.verdict_taps);
    if (gives_map_back && asks_map) {
        renderers.forget_shadow_map();
    }
    return found;
}

} // namespace gnomon::analysis
