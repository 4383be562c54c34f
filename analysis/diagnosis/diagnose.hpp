#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "renderers/reference.hpp"

#include <memory>

namespace gnomon::analysis {

/// The softening at a constant bias of 0 [px], for methods without a bias curve.
[[nodiscard]] Softening softening_without_constant(ObservedLookup at_zero,
                                                   const std::shared_ptr<LightQueryCache>& exact);

/// Finds causes, labels, gaps and the bias curve of a method with a map.
/// @param lookup  The lookup that gave the layers.
[[nodiscard]] Diagnosis diagnose(const ComparedLayers& layers, ObservedLookup lookup,
                                 const DiagnosisRequest& request,
                                 const renderers::Reference& reference);

/// Diagnoses a lookup without a map. Evaluates its rule exactly: casters shadow what lies behind
/// them (docs/causes.md#methods-without-a-map). There is no bias, hence no curve.
[[nodiscard]] Diagnosis diagnose_without_map(const scene::Job& job, const scene::View& view,
                                             const ComparedLayers& layers,
                                             const renderers::Reference& reference);

} // namespace gnomon::analysis
