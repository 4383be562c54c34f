#include "methods/depth/depth_map.hpp"

#include "methods/depth/bias_terms.hpp"
#include "methods/depth/filters.hpp"
#include "methods/depth/terms/receiver_plane.hpp"

#include <array>

namespace gnomon::methods {
namespace {

constexpr auto depth_sources = std::to_array<Source>({
    {"L. Williams", 1978, "Casting curved shadows on curved surfaces", {}},
    {"W. T. Reeves, D. H. Salesin, R. L. Cook", 1987,
     "Rendering antialiased shadows with depth maps", "means of comparisons (pcf)"},
    {"I. Castaño", 2013, "Shadow mapping summary, part 1", "the kernels of bilinear3, 5 and 7"},
});
constexpr auto depth_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

LookupTraits depth_traits(const scene::Job& job)
{
    LookupTraits traits = filter_traits(job.lookup.filter);
    if (has_receiver_plane(job)) {
        // Taps have reference depths of their own, of which no formula knows.
        traits.compares = Compares::none;
        traits.curve = Curve::by_bisection;
    }
    traits.map_bytes = map_bytes(job);
    return traits;
}

Passes depth_passes(const scene::Job& job)
{
    return filter_passes(job.lookup.filter);
}

/// Bytes of a texel: a whole number of GL's smallest formats; u-formats as if GL had them.
std::uint64_t texel_bytes(scene::DepthFormat format)
{
    return format.bits <= 16 ? 2 : 4;
}

} // namespace

Method depth_map()
{
    return {.name = "depth",
            .sentence = "draws the depth of what the light sees first, and compares the receiver's "
                        "depth with it",
            .sources = depth_sources,
            .page = "docs/methods/depth.md",
            .key_tables = depth_tables,
            .keys = {},
            .filters = filters(),
            .bias_terms = bias_terms(),
            .traits = depth_traits,
            .passes = depth_passes};
}

std::uint64_t map_bytes(const scene::Job& job)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    return scene::map_count(job) * side * side * texel_bytes(job.shadow_map.depth_format);
}

} // namespace gnomon::methods
