#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "renderers/reference.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/view/view.hpp"

#include <optional>

namespace gnomon::analysis {

/// Gives a case without positions those that its camera's pixels show.
///
/// Pixels that a silhouette may cross are set aside: how the renderer rounds decides what their
/// centres show. The centres of a pixel and its eight neighbours tell which edges of the mesh are
/// hidden there.
/// @param layers       Without positions; NaN where nothing is to be judged.
/// @param points       P of each pixel of `view`, by exact rays of the case's camera; NaN where it
///                     shows nothing.
/// @param is_mirrored  The renderer's axes, and so its picture, are a mirror image of the mesh's.
/// @throws scene::InputError  if no pixel is left to judge; says why.
void take_camera_positions(scene::CaseLayers& layers, const scene::TriangleScene& mesh,
                           const scene::View& view, const scene::Image<scene::Vec3f>& points,
                           bool is_mirrored);

/// Checks a case, and finds the truth of its pixels.
/// @param tolerance_m  Of the 99th percentile of distances; empty: `default_tolerance_m`.
/// @throws scene::InputError  if the light or camera is invalid, or `objects` names no object.
[[nodiscard]] CheckedCase check_case(const Case& subject, const renderers::RoundedReference& truth,
                                     std::optional<double> tolerance_m);

/// Compares a case's mask with its truth. Fills the result as for GL, as far as the case's data
/// allow; its `evaluation` lists what is left open.
/// @param checked      Without a mistake.
/// @param environment  What drew the mask, and what judges it.
/// @return  It refers to the subject's mesh.
[[nodiscard]] Comparison evaluate(const Case& subject, CheckedCase checked,
                                  const renderers::RoundedReference& truth,
                                  Environment environment);

} // namespace gnomon::analysis
