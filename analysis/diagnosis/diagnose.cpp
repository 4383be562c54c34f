#include "analysis/diagnosis/diagnose.hpp"

#include "analysis/rays/scored_receivers.hpp"

#include <memory>
#include <optional>
#include <utility>

namespace gnomon::analysis {

Softening softening_without_constant(ObservedLookup at_zero,
                                     const std::shared_ptr<LightQueryCache>& exact)
{
    const scene::LookupLayers own = at_zero.layers;
    const scene::Bias bias = at_zero.view.bias;
    LookupCauses causes{exact, std::move(at_zero)};
    const CauseAmounts amounts = causes.causes_of(own, bias.constant, bias.slope).amounts;
    return {amounts.shadow_softening, amounts.light_softening};
}

Diagnosis diagnose(const ComparedLayers& layers, ObservedLookup lookup,
                   const DiagnosisRequest& request, const renderers::Reference& reference)
{
    auto receivers = std::make_shared<ScoredReceivers>(
        layers.receivers, layers.truth, ReceiverUse{.by_many_maps = false, .counts_cells = true});
    auto exact = std::make_shared<LightQueryCache>(layers.triangles, std::move(receivers),
                                                   lookup.job, lookup.view, reference);
    const auto without_constant = std::move(lookup.without_constant);
    LookupAnswers answers{exact, std::move(lookup)};
    std::optional<Softening> at_zero;
    if (without_constant) {
        at_zero = softening_without_constant(without_constant(), exact);
    }
    Diagnosis found = std::move(answers).diagnose(layers.lookup, request, layers.verdict_taps);
    if (at_zero) {
        found.curve.softening_at_zero = at_zero;
    }
    return found;
}

} // namespace gnomon::analysis
