#pragma once

#include "raster_gl/context.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "scene/vec.hpp"

#include <vector>

namespace gnomon::raster_gl {

/// The clip positions that GL's vertex shader gives each vertex of the scene under
/// `clip_from_world`, bit for bit, by transform feedback: what the rasteriser snaps and
/// interpolates.
/// @return  In the order of the scene's vertices.
[[nodiscard]] std::vector<scene::Vec4f> capture_clip_positions(const Context& context,
                                                               const GpuScene& scene,
                                                               const scene::Mat4f& clip_from_world);

} // namespace gnomon::raster_gl
