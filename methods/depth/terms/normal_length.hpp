#pragma once

#include "methods/bias_term.hpp"
#include "scene/job/keys.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::methods {

inline constexpr auto normal_length_keys = std::to_array<std::string_view>({"bias.normal_m"});

inline std::vector<scene::HandedKey> own_normal_length_keys()
{
    return {{scene::make_key("bias.normal_m",
                             "moves the lookup along the geometric normal [{unit}], beside "
                             "normal_texels",
                             "", scene::only(scene::Stage::lookup), "m"),
             scene::RealDomain{.lower = -1e6, .upper = 1e6, .normal_float = true}, 0.0}};
}

inline constexpr std::string_view normal_length_glsl = R"(uniform float normal_length_m;

vec4 normal_length(Receiver receiver, vec4 clip)
{
    vec3 towards_light = receiver.cosine >= 0.0 ? receiver.normal : -receiver.normal;
    precise vec4 moved = clip + light_clip_from_world[map_index] *
                                    vec4(normal_length_m * towards_light, 0.0);
    return moved;
}
)";

inline std::optional<Piece> normal_length_piece(const scene::Job& /*job*/, const scene::View& view)
{
    const float length_m = view.bias.find_handed(normal_length_keys[0]).value_or(0.0F);
    if (length_m == 0) {
        return std::nullopt;
    }
    return Piece{normal_length_glsl, {}, {{"normal_length_m", {length_m}}}};
}

/// Looks up a point above the surface, everywhere as far.
inline constexpr BiasTerm normal_length{
    .name = "normal offset in metres",
    .keys = normal_length_keys,
    .place = BiasPlace::lookup_position,
    .sentence = "looks up P + normal_m · n in place of P: n the geometric normal on the light's "
                "side",
    .function = "normal_length",
    .piece = normal_length_piece,
    .own_keys = own_normal_length_keys};

} // namespace gnomon::methods
