#pragma once

#include "scene/image.hpp"
#include "scene/vec.hpp"

namespace gnomon::analysis {

/// True if a half float holds the number exactly.
[[nodiscard]] bool is_half(float value);

/// True if positions look as if they had been half floats once.
///
/// All of them are values of half, and they are either off their surfaces, or repeat from pixel to
/// pixel, or their steps along rows are not even. Where a camera without perspective looks straight
/// at a plane, exact positions may all be values of half; they are even and do not repeat.
/// @param is_off_surfaces  whether they are not on the mesh.
[[nodiscard]] bool are_rounded_to_half(const scene::Image<scene::Vec3f>& position,
                                       bool is_off_surfaces);

} // namespace gnomon::analysis
