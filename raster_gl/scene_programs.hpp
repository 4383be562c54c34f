#pragma once

#include "raster_gl/program.hpp"
#include "scene/settings/job.hpp"

#include <compare>
#include <optional>

/// The programs that draw the scene's triangles: casters and receivers alike.
namespace gnomon::raster_gl {

/// What scene.vert, what follows it and lookups are compiled with for what a map measures.
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

/// Draws casters.
[[nodiscard]] Program make_caster_program(const CasterOutput& output);
/// Draws the casters that lie behind a layer of depths.
[[nodiscard]] Program make_peeling_program();
/// Draws receivers, with normals where vertices have them.
[[nodiscard]] Program make_receiver_program(bool has_normals);
/// Gives transform feedback the clip positions of vertices.
[[nodiscard]] Program make_position_program();

} // namespace gnomon::raster_gl
