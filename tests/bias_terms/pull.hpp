#pragma once

#include "methods/bias_term.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::tests {

inline constexpr auto pull_keys = std::to_array<std::string_view>({"bias.pull_m"});

inline std::vector<scene::Key> own_pull_keys()
{
    return {scene::added_key(
        scene::make_key("bias.pull_m", "draws the receiver towards the light [{unit}]", "",
                        scene::only(scene::Stage::lookup), "m"),
        scene::RealDomain{.lower = -10, .upper = 10, .normal_float = true}, 0.0)};
}

inline constexpr std::string_view pull_glsl = R"(uniform float pull_depth;

float pull(Receiver receiver, float r)
{
#if REVERSED
    precise float pulled = r + pull_depth;
#else
    precise float pulled = r - pull_depth;
#endif
    return pulled;
}
)";

inline std::optional<methods::GlslSnippet> pull_piece(const scene::Job& /*job*/,
                                                      const scene::View& view)
{
    const double pull_m = view.bias.find_added("bias.pull_m").value_or(0.0F);
    if (pull_m == 0) {
        return std::nullopt;
    }
    return methods::GlslSnippet{
        pull_glsl, {}, {{"pull_depth", {static_cast<float>(pull_m / view.first_map().range_m())}}}};
}

/// A length along a directional light, taken from the receiver's depth.
inline constexpr methods::BiasTerm pull{.name = "pull",
                                        .keys = pull_keys,
                                        .place = methods::BiasPlace::receiver_depth,
                                        .sentence = "r − pull_m / (far − near) in place of r",
                                        .function = "pull",
                                        .snippet = pull_piece,
                                        .own_keys = own_pull_keys};

} // namespace gnomon::tests
