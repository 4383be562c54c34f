#pragma once

#include "scene/job/job.hpp"
#include "scene/light/frustum.hpp"

namespace gnomon::raster_gl {

/// Sets GL up to draw casters into the light's map: clip range, comparison, culling, viewport.
void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings);

/// Maps that fill a quarter of a gigabyte and more are drawn in parts.
[[nodiscard]] bool is_large_map(int resolution_texels);

} // namespace gnomon::raster_gl
