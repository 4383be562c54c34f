#pragma once

#include "methods/bias_term.hpp"
#include "methods/depth/terms/plane_gradient.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::methods {

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
        throw scene::InputError("bias.slope_kernels counts in the kernel's texels, and "
                                "method.radius_m gives it metres; use method.radius_texels");
    }
}

/// What a plane needs under a kernel, whatever its size.
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

} // namespace gnomon::methods
