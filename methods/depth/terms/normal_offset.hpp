#pragma once

#include "methods/bias_term.hpp"
#include "methods/depth/terms/offset_normal.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::methods {

inline constexpr auto normal_offset_keys = std::to_array<std::string_view>({"bias.normal_texels"});

inline constexpr std::string_view normal_offset_glsl =
    R"(uniform float normal_offset_m[MAPS]; // for POSITIONAL at ζ = 1

vec3 normal_offset(Receiver receiver)
{
#if POSITIONAL
    float offset = normal_offset_m[map_index] * receiver.clip.w;
#else
    float offset = normal_offset_m[map_index];
#endif
    vec3 towards_light =
        receiver.cosine >= 0.0 ? receiver.OFFSET_NORMAL : -receiver.OFFSET_NORMAL;
    precise vec3 moved = offset * towards_light;
    return moved;
}
)";

inline double normal_offset_length_m(const scene::Job& job, const scene::View& view,
                                     std::size_t map, double light_distance_m)
{
    const double texels = view.bias.normal_texels;
    return texels *
           view.maps.at(map).texel_width_m(light_distance_m, job.shadow_map.resolution_texels);
}

inline std::optional<GlslSnippet> normal_offset_snippet(const scene::Job& job,
                                                        const scene::View& view)
{
    if (view.bias.normal_texels == 0) {
        return std::nullopt;
    }
    std::vector<float> offsets_m;
    for (std::size_t map = 0; map < view.maps.size(); ++map) {
        offsets_m.push_back(static_cast<float>(normal_offset_length_m(job, view, map, 1.0)));
    }
    return GlslSnippet{normal_offset_glsl,
                       offset_normal_definitions(job),
                       {{"normal_offset_m", std::move(offsets_m)}}};
}

/// Looks up a point above the surface.
inline constexpr BiasTerm normal_offset{
    .name = "normal offset",
    .keys = normal_offset_keys,
    .place = BiasPlace::lookup_position,
    .sentence = "looks up P + normal_texels · w · n in place of P: w a texel's width there, n the "
                "geometric normal on the light's side, or with normal_from = vertices the one "
                "interpolated from the vertices, on the same side",
    .function = "normal_offset",
    .snippet = normal_offset_snippet,
    .length_m = normal_offset_length_m,
    .reads_vertex_normals = follows_vertex_normals};

} // namespace gnomon::methods
