#pragma once

#include "methods/polygon_offset.hpp"
#include "raster_gl/gpu_scene.hpp"
#include "raster_gl/program.hpp"
#include "scene/light/frustum.hpp"
#include "scene/settings/job.hpp"

#include <compare>
#include <optional>

/// The programs and GL state that draw the scene's casters and receivers.
namespace gnomon::raster_gl {

/// The definitions for a map's measure, for scene.vert, the shaders after it, and lookups.
[[nodiscard]] Definitions measure_definitions(scene::Measure measure);

/// The output of a caster pass.
struct CasterOutput {
    scene::MapContent content = scene::MapContent::depth;
    /// The format that the shader converts to; empty for GL's own formats.
    std::optional<scene::DepthFormat::Kind> converted;
    bool primitives = false; ///< whether triangle indices are written

    friend auto operator<=>(const CasterOutput&, const CasterOutput&) = default;
};
[[nodiscard]] CasterOutput caster_output(scene::MapContent content, scene::DepthFormat format,
                                         bool primitives = false);

/// Draws casters.
[[nodiscard]] Program make_caster_program(const CasterOutput& output);
/// Draws casters behind a depth layer.
[[nodiscard]] Program make_peeling_program();
/// Draws receivers, optionally with vertex normals.
[[nodiscard]] Program make_receiver_program(bool has_normals);
/// Writes the vertices' clip positions to transform feedback.
[[nodiscard]] Program make_position_program();

/// Sets clip range, depth test, culling and viewport for drawing casters into a map.
void prepare_to_draw_casters(const scene::LightFrustum& map,
                             const scene::ShadowMapSettings& settings);

/// Scope in which draws have a polygon offset; does nothing if there is none.
class PolygonOffsetScope {
public:
    /// @throws scene::InputError  if the offset has a clamp and the driver does not support one.
    explicit PolygonOffsetScope(const std::optional<methods::PolygonOffset>& offset);
    PolygonOffsetScope(const PolygonOffsetScope&) = delete;
    PolygonOffsetScope& operator=(const PolygonOffsetScope&) = delete;
    ~PolygonOffsetScope();

private:
    bool is_on_ = false;
};

/// Whether a map has more than 4096² depth samples.
[[nodiscard]] bool is_large_map(int resolution_texels, int samples = 1);

/// Draws the casters with `program`, which must be current; draws into a large map in parts.
void draw_casters(const GpuScene& scene, const Program& program, int resolution_texels,
                  int samples = 1);

} // namespace gnomon::raster_gl
