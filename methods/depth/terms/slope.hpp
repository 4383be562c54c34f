#pragma once

#include "methods/bias_term.hpp"

#include <array>
#include <optional>
#include <string_view>

namespace gnomon::methods {

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
