#pragma once

#include "methods/bias_term.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::methods {

inline constexpr auto texel_bias_keys = std::to_array<std::string_view>({"bias.constant_texels"});

inline std::vector<scene::Key> own_texel_bias_keys()
{
    return {scene::added_key(
        scene::make_key("bias.constant_texels",
                        "moves the receiver towards the light, beside the constant bias "
                        "[{unit}]",
                        "", scene::only(scene::Stage::lookup), "texel widths"),
        scene::RealDomain{.lower = -1000, .upper = 1000, .normal_float = true}, 0.0,
        {.values = {0.5, 1.0}})};
}

inline constexpr std::string_view texel_bias_glsl =
    R"(uniform float texel_bias_depth[MAPS]; // for POSITIONAL at ζ = 1

float texel_bias(Receiver receiver, float r)
{
#if POSITIONAL && (ALONG_RAY || ALONG_AXIS)
    float bias = texel_bias_depth[map_index] * receiver.clip.w;
#elif POSITIONAL
    float bias = texel_bias_depth[map_index] / receiver.clip.w;
#else
    float bias = texel_bias_depth[map_index];
#endif
#if REVERSED
    precise float moved = r + bias;
#else
    precise float moved = r - bias;
#endif
    return moved;
}
)";

/// Depth units of a number of texel widths; for a positional light at ζ = 1.
///
/// A length k ζ moves a receiver at ζ by k / (A (1 − k) ζ) depth units, A = 1/near − 1/far.
inline double depth_of_texels(const scene::LightFrustum& map, double texels, int resolution_texels)
{
    const double length = texels * map.texel_width_m(1.0, resolution_texels);
    const scene::DepthRange stored = map.stored_range();
    return stored.projection == scene::Projection::orthographic
               ? length / stored.range_m()
               : length / ((1 / stored.near_m - 1 / stored.far_m) * (1 - length));
}

inline std::optional<GlslSnippet> texel_bias_snippet(const scene::Job& job, const scene::View& view)
{
    const double texels{view.bias.find_added(texel_bias_keys[0]).value_or(0.0F)};
    if (texels == 0) {
        return std::nullopt;
    }
    std::vector<float> depths;
    for (const scene::LightFrustum& map : view.maps) {
        depths.push_back(
            static_cast<float>(depth_of_texels(map, texels, job.shadow_map.resolution_texels)));
    }
    return GlslSnippet{texel_bias_glsl, {}, {{"texel_bias_depth", std::move(depths)}}};
}

/// Used by Unity and Unreal.
inline constexpr BiasTerm texel_bias{
    .name = "texel bias",
    .keys = texel_bias_keys,
    .place = BiasPlace::receiver_depth,
    .sentence = "the depth of a point constant_texels · w nearer to the light in place of r: w a "
                "texel's width there; of a positional light along its axis",
    .function = "texel_bias",
    .snippet = texel_bias_snippet,
    .own_keys = own_texel_bias_keys};

} // namespace gnomon::methods
