#pragma once

#include "raster_gl/context.hpp"
#include "scene/depth/offset_unit.hpp"
#include "scene/settings/job.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// Measures r on flat planes at depths across [0, 1], by the shift that many units cause.
///
/// GL leaves r to the driver: the smallest difference that surely changes what is stored; for float
/// formats it depends on the largest depth of the triangle.
/// @throws scene::InputError        if the driver lacks the format.
/// @throws scene::EnvironmentError  if GL fails.
/// Source: OpenGL 4.6, 14.6.5.
[[nodiscard]] std::vector<scene::OffsetUnit> measure_offset_units(const Context& context,
                                                                  scene::DepthFormat format);

} // namespace gnomon::raster_gl
