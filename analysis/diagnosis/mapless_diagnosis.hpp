#pragma once

#include "analysis/diagnosis/diagnosis.hpp"
#include "renderers/reference.hpp"

namespace gnomon::analysis {

/// The diagnosis of a lookup without a map: its rule, that casters shadow what lies behind them, is
/// evaluated exactly (docs/causes.md#methods-without-a-map). There is no bias, hence no curve.
[[nodiscard]] Diagnosis diagnose_without_map(const scene::Job& job, const scene::View& view,
                                             const ComparedLayers& layers,
                                             const renderers::Reference& reference);

} // namespace gnomon::analysis
