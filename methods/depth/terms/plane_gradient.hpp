#pragma once

#include "methods/bias_term.hpp"
#include "methods/gl_depth.hpp"
#include "methods/passes.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::methods {

/// A definition that lets a snippet call `plane_gradient` (raster_gl/shaders/lookup_map.glsl).
[[nodiscard]] inline Definition asks_for_plane_gradient()
{
    return {"PLANE_GRADIENT", "1"};
}

/// Refuses maps of anything except GL's own depth: only that is linear over a plane.
inline void require_depth_of_plane(const scene::Job& job, std::string_view key)
{
    require_gl_depth(
        job,
        "{1} follows a plane's depth, and shadow_map.content is \"{0}\"; remove one of "
        "them",
        key);
}

/// Calls `require_depth_of_plane` unless the key's number is 0.
/// @throws scene::InputError  if the number is not 0 and the map does not store GL's own depth.
inline void refuse_distances(const scene::Job& job, std::string_view key)
{
    if (number_in(job, key) != 0) {
        require_depth_of_plane(job, key);
    }
}

inline constexpr auto kernel_slope_keys = std::to_array<std::string_view>({"bias.slope_kernels"});

inline std::vector<scene::Key> own_kernel_slope_keys()
{
    return {scene::added_key(
        scene::make_key("bias.slope_kernels",
                        "slope bias in {unit}: of 1 what the receiver's plane rises from the "
                        "middle of the filter's kernel to its corner",
                        "", scene::only(scene::Stage::lookup), "kernels"),
        scene::RealDomain{.lower = -1000, .upper = 1000, .normal_float = true}, 0.0,
        {.values = {0.5, 1.0}})};
}

inline constexpr std::string_view kernel_slope_glsl = R"(uniform float kernel_slope_factor;

float kernel_slope(Receiver receiver, float r)
{
    vec2 gradient = abs(plane_gradient(receiver));
    precise float rise = kernel_slope_factor * 0.5 * float(TAPS_ACROSS) * (gradient.x + gradient.y);
#if REVERSED
    precise float moved = r + rise;
#else
    precise float moved = r - rise;
#endif
    return moved;
}
)";

inline std::optional<GlslSnippet> kernel_slope_snippet(const scene::Job& /*job*/,
                                                       const scene::View& view)
{
    const float factor = view.bias.find_added(kernel_slope_keys[0]).value_or(0.0F);
    if (factor == 0) {
        return std::nullopt;
    }
    return GlslSnippet{
        kernel_slope_glsl, {asks_for_plane_gradient()}, {{"kernel_slope_factor", {factor}}}};
}

inline void check_kernel_slope(const scene::Job& job, const LookupTraits& promised)
{
    refuse_distances(job, kernel_slope_keys[0]);
    if (number_in(job, kernel_slope_keys[0]) != 0 && promised.taps.is_in_metres) {
        throw scene::InputError("bias.slope_kernels counts texels of the kernel, but "
                                "method.radius_m gives metres; use method.radius_texels");
    }
}

/// The bias that a plane needs under a kernel of any size.
inline constexpr BiasTerm kernel_slope{
    .name = "slope by kernel",
    .keys = kernel_slope_keys,
    .place = BiasPlace::receiver_depth,
    .sentence = "r − slope_kernels · K/2 · (|g_u| + |g_v|) in place of r: K texels the kernel's "
                "width, g what the receiver's plane rises per texel",
    .function = "kernel_slope",
    .snippet = kernel_slope_snippet,
    .own_keys = own_kernel_slope_keys,
    .check = check_kernel_slope};

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

/// Depth units of a short length; for a positional light at ζ = 1, where one metre is near · far /
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
