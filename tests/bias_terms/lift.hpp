#pragma once

#include "methods/bias_term.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::tests {

inline constexpr auto lift_keys = std::to_array<std::string_view>({"bias.lift_m"});

inline std::vector<scene::Key> own_lift_keys()
{
    return {scene::added_key(
        scene::make_key("bias.lift_m", "looks up a point nearer to the light [{unit}]", "",
                        scene::only(scene::Stage::lookup), "m"),
        scene::RealDomain{.lower = -10, .upper = 10, .normal_float = true}, 0.0)};
}

inline constexpr std::string_view lift_glsl = R"(uniform float lift_m;

vec3 lift(Receiver receiver)
{
    precise vec3 lifted = lift_m * receiver.to_light;
    return lifted;
}
)";

inline std::optional<methods::GlslSnippet> lift_snippet(const scene::Job& /*job*/,
                                                        const scene::View& view)
{
    const float lift_m = view.bias.find_added("bias.lift_m").value_or(0.0F);
    if (lift_m == 0) {
        return std::nullopt;
    }
    return methods::GlslSnippet{lift_glsl, {}, {{"lift_m", {lift_m}}}};
}

/// Moves the lookup towards the light.
inline constexpr methods::BiasTerm lift{.name = "lift",
                                        .keys = lift_keys,
                                        .place = methods::BiasPlace::lookup_position,
                                        .sentence = "looks up P + lift_m · l in place of P: l the "
                                                    "unit vector towards the light",
                                        .function = "lift",
                                        .snippet = lift_snippet,
                                        .own_keys = own_lift_keys};

} // namespace gnomon::tests
