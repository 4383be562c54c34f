#pragma once

#include "analysis/evaluate/position_check.hpp"
#include "renderers/reference.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/rounded_receivers.hpp"

#include <optional>

namespace gnomon::analysis {

/// The mistake of object numbers or normals that do not suit the surfaces that P lies on; empty if
/// they do, or if there are neither.
///
/// Numbers: with them more than a hundredth of the positions is farther off than tolerated, without
/// them not. Normals: their angle to those of the triangles is beyond acos(0.9) at half the pixels
/// or more, sides ignored; or they point away from the eye there.
/// @param mesh       in the renderer's space, with its roles.
/// @param receivers  of the case.
/// @param truth      of that mesh.
[[nodiscard]] std::optional<ImportMistake>
check_surfaces(const scene::CaseFile& file, const scene::CaseLayers& layers,
               const scene::TriangleScene& mesh, const scene::RoundedReceivers& receivers,
               const renderers::RoundedReference& truth, double tolerance_m);

} // namespace gnomon::analysis
