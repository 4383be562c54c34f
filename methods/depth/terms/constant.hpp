#pragma once

#include "methods/bias_term.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace gnomon::methods {

inline constexpr auto constant_bias_keys = [] {
    std::array<std::string_view, scene::bias_units.size()> keys;
    std::ranges::transform(scene::bias_units, keys.begin(), &scene::BiasUnit::key);
    return keys;
}();

inline constexpr std::string_view constant_bias_glsl = R"(uniform float bias_constant;

float constant_bias(Receiver receiver)
{
    return bias_constant;
}
)";

inline std::optional<GlslSnippet> constant_bias_snippet(const scene::Job& /*job*/,
                                                        const scene::View& view)
{
    return GlslSnippet{constant_bias_glsl, {}, {{"bias_constant", {view.bias.constant}}}};
}

/// b, which the bias curve varies.
inline constexpr BiasTerm constant_bias{
    .name = "constant",
    .keys = constant_bias_keys,
    .place = BiasPlace::receiver_depth,
    .sentence =
        "b = constant, or constant_m / (far − near): in place of r stands fl(r − fl(b + s)), "
        "with s the slope term",
    .function = "constant_bias",
    .snippet = constant_bias_snippet};

inline constexpr auto slope_bias_keys = std::to_array<std::string_view>({"bias.slope"});

inline constexpr std::string_view slope_bias_glsl = R"(uniform float bias_slope;

float slope_bias(Receiver receiver)
{
    precise float slope_term = bias_slope * receiver.tan_theta;
    return slope_term;
}
)";

inline std::optional<GlslSnippet> slope_bias_snippet(const scene::Job& /*job*/,
                                                     const scene::View& view)
{
    return GlslSnippet{slope_bias_glsl, {}, {{"bias_slope", {view.bias.slope}}}};
}

/// Added to b.
inline constexpr BiasTerm slope_bias{
    .name = "slope",
    .keys = slope_bias_keys,
    .place = BiasPlace::receiver_depth,
    .sentence = "s = fl(slope · tan θ), added to b; θ lies between the geometric normal and the "
                "light",
    .function = "slope_bias",
    .snippet = slope_bias_snippet};

} // namespace gnomon::methods
