#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/gl_depth.hpp"
#include "methods/glsl.hpp"
#include "methods/taps/tap_kernel.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto pcss_sources = std::to_array<Source>({
    {"R. Fernando", 2005, "Percentage-closer soft shadows", {}},
});
constexpr auto pcss_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& search_radius_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.search_radius_texels",
                        "radius in which blockers are looked for, and the largest of the mean "
                        "[{unit}]",
                        "", scene::only(Stage::lookup), "texels"),
        scene::RealDomain{.lower = 0.25, .upper = largest_radius_texels}, 8.0,
        {.values = {2.0, 4.0, 16.0}});
    return key;
}
const Key& light_radius_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.light_radius_m",
                                         "radius of a spot's or a point light's disc [{unit}]", "",
                                         scene::only(Stage::lookup), "m"),
                         scene::RealDomain{.lower = 0, .upper = 1000, .normal_float = true}, 0.1);
    return key;
}
const Key& light_angle_key()
{
    static const Key key = scene::added_key(
        scene::make_key(
            "method.light_angle_deg",
            "angle between the middle and the edge of a directional light's disc [{unit}]", "",
            scene::only(Stage::lookup), "deg"),
        scene::RealDomain{.lower = 0, .upper = 45}, 1.0);
    return key;
}
const Key& biased_search_key()
{
    static const Key key = scene::added_key(
        scene::make_key(
            "method.biased_search",
            "takes the bias from the receiver's depth when blockers are looked for, too", "",
            scene::only(Stage::lookup)),
        scene::FlagDomain{}, true, {.values = {false}});
    return key;
}

double pcss_number(const Key& key, const scene::Job& job)
{
    return std::get<double>(key.value_of(job.method));
}

bool has_biased_search(const scene::Job& job)
{
    return std::get<bool>(biased_search_key().value_of(job.method));
}

void pcss_check(const scene::Job& job)
{
    check_taps(job);
    if (scene::map_layout(job) == scene::MapLayout::cascades) {
        throw scene::InputError(
            "method.name = \"pcss\": its search radius would differ between cascades; use "
            "shadow_map.layout = \"single\", or the method \"pcf\"");
    }
    require_gl_depth(job, "method.name = \"pcss\": it computes distances from depths; remove "
                          "shadow_map.content = \"{}\"");
}

/// The traits of the blocker search. The taps of the mean depend on its result.
LookupTraits pcss_traits(const scene::Job& job)
{
    const double radius = pcss_number(search_radius_key(), job);
    const TapKernel& kernel = tap_kernel(job, TapWeights::equal);
    const bool is_biased = has_biased_search(job);
    return {.verdict = Verdict::fraction,
            .compares = Compares::none,
            .monotonicity = {is_biased ? Monotone::no : Monotone::exactly, 0},
            .curve = is_biased ? Curve::none : Curve::by_bisection,
            .width_texels = width_of_radius(radius),
            .weights = Weights::equal,
            .kernel = {},
            .taps = {.places = kernel.places, .radius = radius, .is_turned = is_turned(job)},
            .reads = Reads::whole_map,
            .map_bytes = map_bytes(job)};
}

Passes pcss_passes(const scene::Job& job)
{
    const double angle_rad = pcss_number(light_angle_key(), job) * std::numbers::pi / 180;
    Passes made;
    made.lookup = {glsl_source("blocker_search.glsl"),
                   {{"BIASED_SEARCH", has_biased_search(job) ? "1" : "0"}},
                   {{"light_radius_m", {static_cast<float>(pcss_number(light_radius_key(), job))}},
                    {"light_tangent", {static_cast<float>(std::tan(angle_rad))}}}};
    return made;
}

} // namespace

Method percentage_closer_soft_shadows()
{
    return {.name = "pcss",
            .sentence = "looks for blockers about the receiver, and takes the mean of comparisons "
                        "over the penumbra that their distance gives",
            .sources = pcss_sources,
            .page = "docs/methods/pcss.md",
            .key_tables = pcss_tables,
            .keys = {pattern_key(), taps_key(), turned_key(), search_radius_key(),
                     light_radius_key(), light_angle_key(), biased_search_key()},
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = pcss_traits,
            .passes = pcss_passes,
            .check = pcss_check};
}

} // namespace gnomon::methods
