#pragma once

#include "analysis/evaluate/position_check.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/light/light.hpp"
#include "scene/pixels/rounded_receivers.hpp"
#include "scene/settings/job.hpp"

#include <optional>

namespace gnomon::analysis {

/// The mistake of a mask whose values are not the share of light that a lookup lets through: light
/// times the cosine of its angle, or two other values than 0 and 1 for shadowed and lit. Empty if
/// it is neither, and where the case itself says what its values mean.
/// @param job    what the file says, with the defaults of what it does not.
/// @param truth  of the case's light.
[[nodiscard]] std::optional<ImportMistake>
check_levels(const scene::CaseFile& file, const scene::Job& job, const scene::CaseLayers& layers,
             const scene::Light& light, const scene::RoundedTruth& truth,
             const scene::TriangleScene& mesh);

} // namespace gnomon::analysis
