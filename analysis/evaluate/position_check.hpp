#pragma once

#include "analysis/comparison/evaluation.hpp"
#include "analysis/evaluate/import_mistake.hpp"
#include "renderers/reference.hpp"
#include "scene/camera/camera.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"

#include <optional>
#include <span>
#include <string>

namespace gnomon::analysis {

/// How far positions may be from their surfaces [m]: 2^-16 of the mesh's largest coordinate.
///
/// Rounding to float32 moves a coordinate by 2^-24 of it at most; the rest is for what renderers
/// compute in float32 before. Rounding to half moves it by up to 2^-12.
[[nodiscard]] double default_tolerance_m(const scene::TriangleScene& scene,
                                         const scene::CaseSpace& space);

/// @param distances  [the renderer's units]; not empty.
[[nodiscard]] ImportDistances summarise_distances(std::span<const double> distances,
                                                  double metres_per_unit, double tolerance_m);

/// Positions held to the mesh.
struct PositionCheck {
    ImportDistances distances; ///< of some of the positions, evenly spread
    std::optional<ImportMistake> mistake;
};

/// Finds out whether positions are on the mesh, and if not, which mistake puts them there: half
/// floats, units, axes, handedness, view space, camera-relative, or the position of pixels that
/// show nothing.
/// @param mesh    in the renderer's space.
/// @param camera  the case's, where it has a whole one.
/// @param truth   of that mesh.
[[nodiscard]] PositionCheck
check_positions(const scene::CaseFile& file, const scene::CaseLayers& layers,
                const scene::TriangleScene& mesh, const scene::Camera& camera,
                const renderers::RoundedReference& truth, double tolerance_m);

} // namespace gnomon::analysis
