#pragma once

#include "scene/pixels/map_texels.hpp"

namespace gnomon::scene {

/// The texel that stands where a cube's face would go on beyond its sides; on the face it is the
/// texel itself. raster_gl/shaders/cube_faces.glsl is the same rule in GLSL.
///
/// Beyond one side it is the neighbouring face's, as far from the seam and in the same row or
/// column. Beyond two sides, at a cube's corner, there is no such texel: it is taken across the
/// side that it is farther beyond (of equal ones the one of x), from the other side's last row or
/// column. Source: OpenGL 4.6 core, 8.14.3, "Seamless cube map filtering".
/// Farther beyond than a face is wide the neighbour's last row or column goes on.
[[nodiscard]] Texel texel_across_seams(const Texel& texel, int resolution_texels);

} // namespace gnomon::scene
