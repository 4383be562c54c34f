#pragma once

#include "methods/bias_term.hpp"
#include "methods/gl_depth.hpp"
#include "methods/polygon_offset.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::methods {

inline constexpr auto polygon_offset_keys = std::to_array<std::string_view>(
    {"bias.polygon_offset_factor", "bias.polygon_offset_units", "bias.polygon_offset_clamp"});

inline std::vector<scene::Key> own_polygon_offset_keys()
{
    constexpr scene::RealDomain numbers{.lower = -1e6, .upper = 1e6, .normal_float = true};
    const auto stage = scene::only(scene::Stage::shadow_map);
    return {
        scene::added_key(
            scene::make_key("bias.polygon_offset_factor",
                            "polygon offset of the casters, times the largest change of their "
                            "depth per texel",
                            "", stage),
            numbers, 0.0, {.values = {1.0, 2.0}}),
        scene::added_key(
            scene::make_key("bias.polygon_offset_units",
                            "polygon offset of the casters [{unit}], the smallest difference of "
                            "depths that the driver resolves",
                            "", stage, "r"),
            numbers, 0.0, {.values = {1.0}}),
        scene::added_key(
            scene::make_key("bias.polygon_offset_clamp",
                            "what the polygon offset is limited to, {unit}; 0: nothing", "", stage,
                            "depth units"),
            scene::RealDomain{.lower = -1, .upper = 1, .normal_float = true}, 0.0)};
}

/// Missing for an unbiased map.
inline std::optional<PolygonOffset> drawn_polygon_offset(const scene::View& view)
{
    const auto number = [&view](std::string_view key) {
        return view.bias.find_added(key).value_or(0.0F);
    };
    const PolygonOffset offset{number(polygon_offset_keys[0]), number(polygon_offset_keys[1]),
                               number(polygon_offset_keys[2])};
    return offset.factor == 0 && offset.units == 0 ? std::nullopt : std::optional{offset};
}

/// GL offsets only depths that it stores itself.
inline void check_polygon_offset(const scene::Job& job, const LookupTraits& /*promised*/)
{
    const bool is_set =
        number_in(job, polygon_offset_keys[0]) != 0 || number_in(job, polygon_offset_keys[1]) != 0;
    if (!is_set) {
        if (number_in(job, polygon_offset_keys[2]) != 0) {
            throw scene::InputError("bias.polygon_offset_clamp limits a polygon offset, but none "
                                    "is set; set bias.polygon_offset_factor or _units");
        }
        return;
    }
    require_gl_depth(job, "bias.polygon_offset_factor and _units offset depths, and "
                          "shadow_map.content is \"{}\"; remove one of them");
    if (traits_of(job.shadow_map.depth_format).conversion == scene::Conversion::shader) {
        throw scene::InputError(fmt::format(
            "shadow_map.depth_format = \"{}\" is written by a shader, which GL's polygon offset "
            "does not change; use d16, d24, d32 or d32f",
            scene::depth_format_name(job.shadow_map.depth_format)));
    }
}

/// Pushes casters in the map away from the light.
inline constexpr BiasTerm polygon_offset{
    .name = "polygon offset",
    .keys = polygon_offset_keys,
    .place = BiasPlace::map_drawn,
    .sentence = "d + factor · m + units · r in place of d, limited to clamp: m the largest change "
                "of the caster's depth per texel, r the smallest difference that the driver "
                "resolves, both the driver's own",
    .own_keys = own_polygon_offset_keys,
    .offset = drawn_polygon_offset,
    .check = check_polygon_offset};

} // namespace gnomon::methods
