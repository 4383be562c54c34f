// This program's list of methods, linked instead of the library's: depth has two more bias terms.

#include "methods/list.hpp"

#include "methods/all_methods.hpp"
#include "methods/bias_term.hpp"
#include "methods/depth/depth_map.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::tests {
namespace {

constexpr auto lift_keys = std::to_array<std::string_view>({"bias.lift_m"});

std::vector<scene::Key> own_lift_keys()
{
    return {scene::added_key(
        scene::make_key("bias.lift_m", "looks up a point nearer to the light [{unit}]", "",
                        scene::only(scene::Stage::lookup), "m"),
        scene::RealDomain{.lower = -10, .upper = 10, .normal_float = true}, 0.0)};
}

constexpr std::string_view lift_glsl = R"(uniform float lift_m;

vec3 lift(Receiver receiver)
{
    precise vec3 lifted = lift_m * receiver.to_light;
    return lifted;
}
)";

std::optional<methods::GlslSnippet> lift_snippet(const scene::Job& /*job*/, const scene::View& view)
{
    const float lift_m = view.bias.find_added("bias.lift_m").value_or(0.0F);
    if (lift_m == 0) {
        return std::nullopt;
    }
    return methods::GlslSnippet{lift_glsl, {}, {{"lift_m", {lift_m}}}};
}

/// Moves the lookup towards the light.
constexpr methods::BiasTerm lift{.name = "lift",
                                 .keys = lift_keys,
                                 .place = methods::BiasPlace::lookup_position,
                                 .sentence = "looks up P + lift_m · l in place of P: l the "
                                             "unit vector towards the light",
                                 .function = "lift",
                                 .snippet = lift_snippet,
                                 .own_keys = own_lift_keys};

constexpr auto pull_keys = std::to_array<std::string_view>({"bias.pull_m"});

std::vector<scene::Key> own_pull_keys()
{
    return {scene::added_key(
        scene::make_key("bias.pull_m", "draws the receiver towards the light [{unit}]", "",
                        scene::only(scene::Stage::lookup), "m"),
        scene::RealDomain{.lower = -10, .upper = 10, .normal_float = true}, 0.0)};
}

constexpr std::string_view pull_glsl = R"(uniform float pull_depth;

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

std::optional<methods::GlslSnippet> pull_piece(const scene::Job& /*job*/, const scene::View& view)
{
    const double pull_m = view.bias.find_added("bias.pull_m").value_or(0.0F);
    if (pull_m == 0) {
        return std::nullopt;
    }
    return methods::GlslSnippet{
        pull_glsl, {}, {{"pull_depth", {static_cast<float>(pull_m / view.first_map().range_m())}}}};
}

/// A length along a directional light, taken from the receiver's depth.
constexpr methods::BiasTerm pull{.name = "pull",
                                 .keys = pull_keys,
                                 .place = methods::BiasPlace::receiver_depth,
                                 .sentence = "r − pull_m / (far − near) in place of r",
                                 .function = "pull",
                                 .snippet = pull_piece,
                                 .own_keys = own_pull_keys};

} // namespace
} // namespace gnomon::tests

namespace gnomon::methods {
namespace {

Method depth_with_more_terms()
{
    static const std::vector<BiasTerm> terms = [] {
        std::vector<BiasTerm> all{bias_terms().begin(), bias_terms().end()};
        all.push_back(tests::pull);
        all.push_back(tests::lift);
        return all;
    }();
    Method depth = depth_map();
    depth.bias_terms = terms;
    return depth;
}

} // namespace

std::span<const Method> methods()
{
    static const std::array list{depth_with_more_terms(), variance_map()};
    return list;
}

} // namespace gnomon::methods
