#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "renderers/reference.hpp"

#include <memory>

namespace gnomon::analysis {

/// The softening with a constant bias of 0 [px], of that lookup: for methods without a bias curve.
[[nodiscard]] Softening softening_without_constant(ObservedLookup at_zero,
                                                   const std::shared_ptr<LightQueryCache>& exact);

/// Finds causes, labels, gaps and the bias curve of a method with a map.
/// @param lookup  of the layers.
[[nodiscard]] Diagnosis diagnose(const ComparedLayers& layers, ObservedLookup lookup,
                                 const DiagnosisRequest& request,
                                 const renderers::Reference& reference);

} // namespace gnomon::analysis
