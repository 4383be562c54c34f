#pragma once

#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/job/job.hpp"
#include "scene/light/frustum.hpp"

namespace gnomon::raster_gl {

/// What a pass of casters writes beside GL's own depth.
struct CasterOutput {
    scene::MapContent content = scene::MapContent::depth;
    bool is_unorm = false; ///< quantised by the shader

    friend bool operator==(const CasterOutput&, const CasterOutput&) = default;
};
/// Compiles the program that draws casters.
[[nodiscard]] Program make_caster_program(const CasterOutput& output);

/// Sets GL up to draw casters into the light's map: clip range, comparison, culling, viewport.
void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings);

/// Maps that fill a quarter of a gigabyte and more.
[[nodiscard]] bool is_large_map(int resolution_texels, int samples = 1);

/// Draws the casters with the program in use; into a large map in parts.
void draw_casters(const GpuScene& scene, int resolution_texels, int samples = 1);

} // namespace gnomon::raster_gl
