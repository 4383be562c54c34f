#pragma once

#include "methods/bias_term.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::methods {

inline constexpr auto normal_offset_keys = std::to_array<std::string_view>({"bias.normal_texels"});

inline constexpr std::string_view normal_offset_glsl =
    R"(uniform float normal_offset_m[MAPS]; // for POSITIONAL at ζ = 1

vec4 normal_offset(Receiver receiver, vec4 clip)
{
#if POSITIONAL
    float offset = normal_offset_m[map_index] * receiver.clip.w;
#else
    float offset = normal_offset_m[map_index];
#endif
    vec3 towards_light = receiver.cosine >= 0.0 ? receiver.normal : -receiver.normal;
    precise vec4 moved = clip + light_clip_from_world[map_index] * vec4(offset * towards_light, 0.0);
    return moved;
}
)";

inline std::optional<Piece> normal_offset_piece(const scene::Job& job, const scene::View& view)
{
    const double texels = view.bias.normal_texels;
    if (texels == 0) {
        return std::nullopt;
    }
    std::vector<float> offsets_m;
    for (const scene::LightFrustum& map : view.maps) {
        const double texel_m = map.texel_width_m(1.0, job.shadow_map.resolution_texels);
        offsets_m.push_back(static_cast<float>(texels * texel_m));
    }
    return Piece{normal_offset_glsl, {}, {{"normal_offset_m", std::move(offsets_m)}}};
}

/// Looks up a point above the surface.
inline constexpr BiasTerm normal_offset{
    .name = "normal offset",
    .keys = normal_offset_keys,
    .place = BiasPlace::lookup_position,
    .sentence = "looks up P + normal_texels · w · n in place of P: w a texel's width there, n the "
                "geometric normal on the light's side",
    .function = "normal_offset",
    .piece = normal_offset_piece};

} // namespace gnomon::methods
