#pragma once

#include "methods/passes.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::methods {

inline constexpr std::string_view offset_normal_key = "bias.normal_from";

/// The row of that key.
inline scene::Key offset_normal_row()
{
    return scene::added_key(
        scene::make_key(std::string{offset_normal_key},
                        "whose normal normal_texels and normal_m move the lookup along: the "
                        "triangle's, or that interpolated from its vertices",
                        "", scene::only(scene::Stage::lookup)),
        scene::WordDomain{.words = {"geometry", "vertices"}}, std::string{"geometry"});
}

/// Whether lookups are offset along the normals of vertices.
[[nodiscard]] inline bool follows_vertex_normals(const scene::Job& job)
{
    const scene::JobValue* normal = scene::find_added_value(job, offset_normal_key);
    return normal != nullptr && std::get<std::string>(*normal) == "vertices";
}

/// With them a piece of GLSL has `receiver.OFFSET_NORMAL`, the unit normal on the geometric one's
/// side (raster_gl/shaders/lookup_map.glsl).
[[nodiscard]] inline std::vector<Definition> offset_normal_definitions(const scene::Job& job)
{
    if (!follows_vertex_normals(job)) {
        return {{"OFFSET_NORMAL", "normal"}};
    }
    return {{std::string{vertex_normals_definition}, "1"}, {"OFFSET_NORMAL", "vertex_normal"}};
}

} // namespace gnomon::methods
