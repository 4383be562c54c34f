#pragma once

#include "methods/bias_term.hpp"
#include "methods/depth/terms/plane_gradient.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::methods {

inline constexpr auto receiver_plane_keys =
    std::to_array<std::string_view>({"bias.receiver_plane", "bias.receiver_plane_clamp"});

inline std::vector<scene::Key> own_receiver_plane_keys()
{
    const auto stage = scene::only(scene::Stage::lookup);
    return {
        scene::added_key(
            scene::make_key("bias.receiver_plane",
                            "compares each tap with the receiver's plane at the texel's centre: "
                            "analytic by its normal, derivatives by the neighbouring pixels",
                            "", stage),
            scene::WordDomain{.words = {"off", "analytic", "derivatives"}}, std::string{"off"},
            {.values = {std::string{"analytic"}, std::string{"derivatives"}}}),
        scene::added_key(
            scene::make_key("bias.receiver_plane_clamp",
                            "what the plane may rise over two texels each way, {unit}; where it "
                            "rises more, it is made flatter; 0: no limit",
                            "", stage, "depth units"),
            scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true}, 0.0,
            {.values = {0.01}})};
}

/// "off", "analytic" or "derivatives".
[[nodiscard]] inline std::string receiver_plane_of(const scene::Job& job)
{
    const scene::JobValue* value = scene::find_added_value(job, receiver_plane_keys[0]);
    return value == nullptr ? std::string{"off"} : std::get<std::string>(*value);
}

/// Whether each tap has a reference depth of its own.
[[nodiscard]] inline bool has_receiver_plane(const scene::Job& job)
{
    return receiver_plane_of(job) != "off";
}

inline constexpr std::string_view receiver_plane_glsl = R"(uniform float receiver_plane_clamp;

#if BY_DERIVATIVES
vec4 light_clip_of(ivec2 pixel);

// Of a pixel that shows a surface: where it is in the map, in texels, and its depth.
bool map_point(ivec2 pixel, out vec3 point)
{
    point = vec3(0.0);
    if (any(greaterThanEqual(pixel, textureSize(receiver_triangle, 0))) ||
        texelFetch(receiver_triangle, pixel, 0).r == 0xFFFFFFFFu) {
        return false;
    }
    vec4 clip = light_clip_of(pixel);
    vec3 ndc = clip.xyz / clip.w;
    point = vec3((ndc.xy * 0.5 + 0.5) * resolution, ndc.z * (REVERSED != 0 ? 1.0 : 0.5));
    return true;
}

// By differences within squares of 2 × 2 pixels, as hardware takes them; 0 where one is missing.
vec2 receiver_gradient(Receiver receiver)
{
    ivec2 first = ivec2(gl_FragCoord.xy) & ~1;
    ivec2 second = first | 1;
    ivec2 here = ivec2(gl_FragCoord.xy);
    vec3 left;
    vec3 right;
    vec3 below;
    vec3 above;
    if (!map_point(ivec2(first.x, here.y), left) || !map_point(ivec2(second.x, here.y), right) ||
        !map_point(ivec2(here.x, first.y), below) || !map_point(ivec2(here.x, second.y), above)) {
        return vec2(0.0);
    }
    vec3 dx = right - left;
    vec3 dy = above - below;
    float area = dx.x * dy.y - dx.y * dy.x;
    return area == 0.0 ? vec2(0.0)
                       : vec2(dy.y * dx.z - dx.y * dy.z, dx.x * dy.z - dy.x * dx.z) / area;
}
#else
vec2 receiver_gradient(Receiver receiver)
{
    return plane_gradient(receiver);
}
#endif

vec2 receiver_plane(Receiver receiver)
{
    vec2 gradient = receiver_gradient(receiver);
    float rise = 2.0 * (abs(gradient.x) + abs(gradient.y));
    bool is_steep = receiver_plane_clamp > 0.0 && rise > receiver_plane_clamp;
    return is_steep ? gradient * (receiver_plane_clamp / rise) : gradient;
}
)";

inline std::optional<GlslSnippet> receiver_plane_snippet(const scene::Job& job,
                                                         const scene::View& view)
{
    const std::string how = receiver_plane_of(job);
    const auto most = view.bias.find_added(receiver_plane_keys[1]);
    if (how == "off" || !most) { // missing for an unbiased lookup
        return std::nullopt;
    }
    return GlslSnippet{
        receiver_plane_glsl,
        {asks_for_plane_gradient(), {"BY_DERIVATIVES", how == "derivatives" ? "1" : "0"}},
        {{"receiver_plane_clamp", {*most}}}};
}

inline void check_receiver_plane(const scene::Job& job, const LookupTraits& /*promised*/)
{
    if (!has_receiver_plane(job)) {
        return;
    }
    require_depth_of_plane(job, receiver_plane_keys[0]);
    if (job.method.name != "depth" || job.lookup.filter == scene::Filter::linear) {
        throw scene::InputError(
            fmt::format("bias.receiver_plane needs method.name = \"depth\" and another "
                        "lookup.filter than \"linear\"; method.name is \"{}\", lookup.filter "
                        "\"{}\": remove the key, or use that method with another filter",
                        job.method.name, scene::filter_name(job.lookup.filter)));
    }
}

/// Source: J. R. Isidoro, "Shadow mapping: GPU-based tips and techniques", GDC 2006.
inline constexpr BiasTerm receiver_plane{
    .name = "receiver plane",
    .keys = receiver_plane_keys,
    .place = BiasPlace::per_tap,
    .sentence = "r + g · t in place of r, for a tap whose centre is t texels away; g what the "
                "receiver's plane rises per texel, made smaller where 2(|g_u| + |g_v|) exceeds "
                "receiver_plane_clamp. hardware: r − 2(|g_u| + |g_v|), for all its taps",
    .function = "receiver_plane",
    .snippet = receiver_plane_snippet,
    .own_keys = own_receiver_plane_keys,
    .check = check_receiver_plane};

} // namespace gnomon::methods
