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

/// b, which a bias curve varies.
inline constexpr BiasTerm constant_bias{
    .name = "constant",
    .keys = constant_bias_keys,
    .place = BiasPlace::receiver_depth,
    .sentence =
        "b = constant, or constant_m / (far − near): in place of r stands fl(r − fl(b + s)), "
        "with s the slope term",
    .function = "constant_bias",
    .snippet = constant_bias_snippet};

} // namespace gnomon::methods
