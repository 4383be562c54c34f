#pragma once

#include "analysis/answers/diagnosis.hpp"
#include "analysis/answers/exact_light_cache.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/renderers.hpp"

#include <memory>
#include <optional>

namespace gnomon::analysis {

/// The softening with a constant bias of 0 [px], found by looking up again: for methods without a
/// bias curve. Asks `look_up`, which must answer for the job's receivers and map.
/// @return  Empty if another renderer recorded no such lookup.
[[nodiscard]] std::optional<Softening> softening_without_constant(
    const scene::Job& job, scene::View view, const scene::TriangleScene& triangles,
    const std::shared_ptr<ExactLightCache>& exact, const Renderers& renderers);

/// Finds causes, labels, gaps and the bias curve. Asks `look_up`, `read_map_depths` and
/// `make_exact_light`, which must still answer for the job's receivers and map.
[[nodiscard]] Diagnosis diagnose(const scene::Job& job, const scene::View& view,
                                 const ComparedLayers& layers, const DiagnosisRequest& request,
                                 const Renderers& renderers);

} // namespace gnomon::analysis
