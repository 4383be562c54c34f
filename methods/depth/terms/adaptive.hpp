#pragma once

#include "methods/bias_term.hpp"
#include "methods/depth/terms/plane_gradient.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::methods {

inline constexpr auto adaptive_bias_keys = std::to_array<std::string_view>({"bias.adaptive_m"});

inline std::vector<scene::Key> own_adaptive_bias_keys()
{
    return {scene::added_key(
        scene::make_key("bias.adaptive_m",
                        "adaptive bias, and the length [{unit}] that it adds; 0: none", "",
                        scene::only(scene::Stage::lookup), "m"),
        scene::RealDomain{.lower = 0, .upper = 1e6, .normal_float = true}, 0.0,
        {.values = {1e-4, 1e-3}, .unit = scene::TriedUnit::scene_diagonals})};
}

inline constexpr std::string_view adaptive_bias_glsl =
    R"(uniform float adaptive_depth[MAPS]; // for POSITIONAL at ζ = 1

float adaptive_bias(Receiver receiver, float r)
{
    precise vec2 texel = (receiver.clip.xy / receiver.clip.w * 0.5 + 0.5) * resolution;
    precise vec2 to_centre = floor(texel) + 0.5 - texel;
    vec2 gradient = plane_gradient(receiver);
    precise float rise = gradient.x * to_centre.x + gradient.y * to_centre.y;
#if POSITIONAL
    precise float epsilon = adaptive_depth[map_index] / (receiver.clip.w * receiver.clip.w);
#else
    float epsilon = adaptive_depth[map_index];
#endif
#if REVERSED
    precise float moved = r + max(rise, 0.0) + epsilon;
#else
    precise float moved = r + min(rise, 0.0) - epsilon;
#endif
    return moved;
}
)";

/// Depth units that a short length is, for a positional light at ζ = 1: times near · far /
/// ((far − near) ζ²).
inline double depth_of_length(const scene::LightFrustum& map, double length_m)
{
    return map.projection == scene::Projection::orthographic
               ? length_m / map.range_m()
               : length_m * map.near_m * map.far_m / map.range_m();
}

inline std::optional<GlslSnippet> adaptive_bias_snippet(const scene::Job& /*job*/,
                                                        const scene::View& view)
{
    const double length_m{view.bias.find_added(adaptive_bias_keys[0]).value_or(0.0F)};
    if (length_m == 0) {
        return std::nullopt;
    }
    std::vector<float> depths;
    for (const scene::LightFrustum& map : view.maps) {
        depths.push_back(static_cast<float>(depth_of_length(map, length_m)));
    }
    return GlslSnippet{
        adaptive_bias_glsl, {asks_for_plane_gradient()}, {{"adaptive_depth", std::move(depths)}}};
}

inline void check_adaptive_bias(const scene::Job& job, const LookupTraits& /*promised*/)
{
    refuse_distances(job, adaptive_bias_keys[0]);
}

/// Source: H. Dou, Y. Yan, E. Kerzner, Z. Dai, C. Wyman, "Adaptive depth bias for shadow maps",
/// I3D 2014.
inline constexpr BiasTerm adaptive_bias{
    .name = "adaptive",
    .keys = adaptive_bias_keys,
    .place = BiasPlace::receiver_depth,
    .sentence = "min(r, the depth of the receiver's plane at the centre of the texel looked up) − "
                "ε in place of r, ε the depth units of adaptive_m there",
    .function = "adaptive_bias",
    .snippet = adaptive_bias_snippet,
    .own_keys = own_adaptive_bias_keys,
    .check = check_adaptive_bias};

} // namespace gnomon::methods
