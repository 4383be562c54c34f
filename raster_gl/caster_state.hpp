#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <optional>

namespace gnomon::raster_gl {

/// Sets GL up to draw casters into the light's map: clip range, comparison, culling, viewport.
void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings);

/// While it lives, what is drawn has its depth offset; without an offset nothing is changed.
class OffsetDraws {
public:
    /// @throws scene::InputError  if the offset has a clamp, and the driver lacks such.
    explicit OffsetDraws(const std::optional<methods::PolygonOffset>& offset);
    OffsetDraws(const OffsetDraws&) = delete;
    OffsetDraws& operator=(const OffsetDraws&) = delete;
    ~OffsetDraws();

private:
    bool is_on_ = false;
};

/// Maps that fill a quarter of a gigabyte and more.
[[nodiscard]] bool is_large_map(int resolution_texels, int samples = 1);

/// Draws the casters with `program`, which is in use; into a large map in parts.
void draw_casters(const GpuScene& scene, const Program& program, int resolution_texels,
                  int samples = 1);

} // namespace gnomon::raster_gl
