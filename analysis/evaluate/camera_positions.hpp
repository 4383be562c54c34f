#pragma once

#include "scene/case/case_layers.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/view/view.hpp"

namespace gnomon::analysis {

/// By how much a pixel's square is grown on each side before silhouettes are looked for in it [px]:
/// twice what a rasteriser may move a corner to its grid, which has at least 4 bits in GL, Direct3D
/// and Vulkan.
inline constexpr double silhouette_margin_px = 0x1p-4;

/// Gives a case that has none the positions that its camera's pixels show.
///
/// A pixel whose grown square holds a silhouette is set aside: what its centre shows depends on how
/// the renderer rounds. Which of the mesh's edges are hidden is told by what the centres of the
/// pixel and of its eight neighbours show.
/// @param layers       without positions, and NaN where nothing is to be judged.
/// @param points       P of each pixel of `view`, by exact rays of the case's camera; NaN where it
///                     shows nothing.
/// @param is_mirrored  The renderer's axes are a mirror image of the mesh's: so is its picture.
/// @throws scene::InputError  if no pixel is left to be judged, saying why.
void take_camera_positions(scene::CaseLayers& layers, const scene::TriangleScene& mesh,
                           const scene::View& view, const scene::Image<scene::Vec3f>& points,
                           bool is_mirrored);

} // namespace gnomon::analysis
