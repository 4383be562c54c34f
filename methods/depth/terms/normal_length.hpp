#pragma once

#include "methods/bias_term.hpp"
#include "methods/depth/terms/offset_normal.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::methods {

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

/// Looks up a point above the surface, everywhere as far.
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
