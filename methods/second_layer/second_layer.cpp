#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/gl_depth.hpp"
#include "methods/glsl.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto layer_sources = std::to_array<Source>({
    {"A. Woo", 1992, "The shadow depth map revisited (Graphics Gems III)", "the midpoint"},
    {"Y. Wang, S. Molnar", 1994, "Second-depth shadow mapping", "the second surface"},
    {"D. Weiskopf, T. Ertl", 2003, "Shadow mapping based on dual depth layers",
     "the midpoint, limited"},
});
constexpr auto layer_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& compared_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.compared",
                        "what of the two surfaces is compared: the middle between them, the "
                        "second, or the middle but no farther than largest_offset",
                        "", scene::only(Stage::prefilter)),
        scene::WordDomain{.words = {"midpoint", "second", "dual"}}, std::string{"midpoint"},
        {.values = {std::string{"second"}, std::string{"dual"}}});
    return key;
}
const Key& largest_offset_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.largest_offset",
                        "of dual how far behind the first surface at most [{unit}]", "",
                        scene::only(Stage::prefilter), "depth units"),
        scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true}, 0.01,
        {.values = {0.001, 0.1}});
    return key;
}

void layer_check(const scene::Job& job)
{
    const scene::ShadowMapSettings& map = job.shadow_map;
    if (number_in(job, "bias.polygon_offset_factor") != 0 ||
        number_in(job, "bias.polygon_offset_units") != 0) {
        throw scene::InputError("method.name = \"second_layer\" separates layers by their depths, "
                                "which a polygon offset moves; remove bias.polygon_offset_*");
    }
    if (map.cull != scene::Cull::none) {
        throw scene::InputError(
            fmt::format("shadow_map.cull = \"{}\": removes one of the two surfaces that "
                        "method.name = \"second_layer\" needs; remove it",
                        scene::cull_name(map.cull)));
    }
    require_gl_depth(job, "method.name = \"second_layer\": its layers hold depths; remove "
                          "shadow_map.content = \"{}\"");
    if (map.depth_format.kind != scene::DepthFormat::Kind::d32f) {
        throw scene::InputError(
            fmt::format("shadow_map.depth_format = \"{}\": method.name = \"second_layer\" "
                        "separates its layers by unrounded depths; use d32f",
                        scene::depth_format_name(map.depth_format)));
    }
}

/// Memory of the map, both layers, and the two floats computed from them.
std::uint64_t layer_bytes(const scene::Job& job)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    return 3 * map_bytes(job) + scene::map_count(job) * side * side * 8;
}

LookupTraits layer_traits(const scene::Job& job)
{
    return {.verdict = Verdict::binary,
            .compares = Compares::none,
            .monotonicity = {Monotone::exactly, 0},
            .curve = Curve::by_bisection,
            .width_texels = 1,
            .weights = Weights::equal,
            .kernel = {},
            .layers = 2,
            .map_bytes = layer_bytes(job)};
}

Passes layer_passes(const scene::Job& job)
{
    const auto& compared = std::get<std::string>(compared_key().value_of(job.method));
    // 1 means no limit, because depths differ by at most 1.
    const double largest =
        compared == "dual" ? std::get<double>(largest_offset_key().value_of(job.method)) : 1.0;
    Passes made;
    made.layers = 2;
    made.prefilter.push_back({{glsl_source("between_layers.glsl"),
                               {{"SECOND_ALONE", compared == "second" ? "1" : "0"}},
                               {{"largest_offset", {static_cast<float>(largest)}}}},
                              TexelFormat::rg32f});
    made.lookup = {glsl_source("compared_layer.glsl")};
    return made;
}

} // namespace

Method second_layer_map()
{
    return {.name = "second_layer",
            .sentence = "keeps the two surfaces that the light sees first, and compares with what "
                        "lies between them",
            .sources = layer_sources,
            .page = "docs/methods/second_layer.md",
            .key_tables = layer_tables,
            .keys = {compared_key(), largest_offset_key()},
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = layer_traits,
            .passes = layer_passes,
            .check = layer_check};
}

} // namespace gnomon::methods
