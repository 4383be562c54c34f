#pragma once

#include "methods/bias_term.hpp"
#include "methods/passes.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::methods {

inline constexpr std::string_view offset_normal_key = "bias.normal_from";

/// The key `bias.normal_from`.
inline scene::Key offset_normal_row()
{
    return scene::added_key(
        scene::make_key(std::string{offset_normal_key},
                        "whose normal normal_texels and normal_m move the lookup along: the "
                        "triangle's, or that interpolated from its vertices",
                        "", scene::only(scene::Stage::lookup)),
        scene::WordDomain{.words = {"geometry", "vertices"}}, std::string{"geometry"});
}

/// Whether lookups are offset along vertex normals.
[[nodiscard]] inline bool follows_vertex_normals(const scene::Job& job)
{
    const scene::JobValue* normal = scene::find_added_value(job, offset_normal_key);
    return normal != nullptr && std::get<std::string>(*normal) == "vertices";
}

/// Definitions that give a snippet `receiver.OFFSET_NORMAL`, the unit normal on the geometric
/// normal's side (raster_gl/shaders/lookup_map.glsl).
[[nodiscard]] inline std::vector<Definition> offset_normal_definitions(const scene::Job& job)
{
    if (!follows_vertex_normals(job)) {
        return {{"OFFSET_NORMAL", "normal"}};
    }
    return {{std::string{vertex_normals_definition}, "1"}, {"OFFSET_NORMAL", "vertex_normal"}};
}

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

inline constexpr auto normal_length_keys =
    std::to_array<std::string_view>({"bias.normal_m", offset_normal_key});

inline std::vector<scene::Key> own_normal_length_keys()
{
    return {scene::added_key(scene::make_key("bias.normal_m",
                                             "moves the lookup along the normal [{unit}], beside "
                                             "normal_texels",
                                             "", scene::only(scene::Stage::lookup), "m"),
                             scene::RealDomain{.lower = -1e6, .upper = 1e6, .normal_float = true},
                             0.0, {.values = {1.0}, .unit = scene::TriedUnit::texel_widths}),
            offset_normal_row()};
}

inline constexpr std::string_view normal_length_glsl = R"(uniform float normal_length_m;

vec3 normal_length(Receiver receiver)
{
    vec3 towards_light =
        receiver.cosine >= 0.0 ? receiver.OFFSET_NORMAL : -receiver.OFFSET_NORMAL;
    precise vec3 moved = normal_length_m * towards_light;
    return moved;
}
)";

inline float normal_length_of(const scene::View& view)
{
    return view.bias.find_added(normal_length_keys[0]).value_or(0.0F);
}

inline double normal_length_m(const scene::Job& /*job*/, const scene::View& view,
                              std::size_t /*map*/, double /*light_distance_m*/)
{
    return normal_length_of(view);
}

inline std::optional<GlslSnippet> normal_length_snippet(const scene::Job& job,
                                                        const scene::View& view)
{
    const float length_m = normal_length_of(view);
    if (length_m == 0) {
        return std::nullopt;
    }
    return GlslSnippet{
        normal_length_glsl, offset_normal_definitions(job), {{"normal_length_m", {length_m}}}};
}

/// Looks up a point at a constant distance above the surface.
inline constexpr BiasTerm normal_length{
    .name = "normal offset in metres",
    .keys = normal_length_keys,
    .place = BiasPlace::lookup_position,
    .sentence = "looks up P + normal_m · n in place of P: n as for the normal offset",
    .function = "normal_length",
    .snippet = normal_length_snippet,
    .own_keys = own_normal_length_keys,
    .length_m = normal_length_m,
    .reads_vertex_normals = follows_vertex_normals};

} // namespace gnomon::methods
