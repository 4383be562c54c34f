#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <compare>
#include <optional>

namespace gnomon::raster_gl {

/// What shadow_map.vert, what follows it and lookups are compiled with for what a map measures.
[[nodiscard]] Definitions measure_definitions(scene::Measure measure);

/// What a pass of casters writes.
struct CasterOutput {
    scene::MapContent content = scene::MapContent::depth;
    /// Of formats that the shader converts; empty: GL's own, or distances as they are.
    std::optional<scene::DepthFormat::Kind> converted;
    bool primitives = false; ///< which triangle, too

    friend auto operator<=>(const CasterOutput&, const CasterOutput&) = default;
};
[[nodiscard]] CasterOutput caster_output(scene::MapContent content, scene::DepthFormat format,
                                         bool primitives = false);

/// Compiles the program that draws casters.
[[nodiscard]] Program make_caster_program(const CasterOutput& output);

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
