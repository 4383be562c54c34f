#pragma once

#include "raster_gl/gpu_scene.hpp"
#include "scene/job/job.hpp"
#include "scene/light/frustum.hpp"

namespace gnomon::raster_gl {

/// Sets GL up to draw casters into the light's map: clip range, comparison, culling, viewport.
void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings);

/// Maps that fill a quarter of a gigabyte and more.
[[nodiscard]] bool is_large_map(int resolution_texels, int samples = 1);

/// Draws the casters with the program in use; into a large map in parts.
void draw_casters(const GpuScene& scene, int resolution_texels, int samples = 1);

} // namespace gnomon::raster_gl
