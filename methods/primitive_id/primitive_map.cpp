#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/gl_depth.hpp"
#include "methods/glsl.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace gnomon::methods {
namespace {

constexpr auto primitive_sources = std::to_array<Source>({
    {"J. C. Hourcade, A. Nicolas", 1985, "Algorithms for antialiased cast shadows",
     "an index of what the light sees in place of a depth"},
});
constexpr auto primitive_tables = std::to_array<std::string_view>({"shadow_map", "lookup"});

void primitive_check(const scene::Job& job)
{
    if (scene::mixes_maps(job)) {
        throw scene::InputError("method.name = \"primitive_id\": indices of two maps cannot be "
                                "mixed; remove shadow_map.blend");
    }
    require_gl_depth(job, "method.name = \"primitive_id\": its map stores which triangle the light "
                          "sees, and no distances; remove shadow_map.content = \"{}\"");
}

/// Depth for the visibility test, and an index of 4 bytes.
std::uint64_t primitive_map_bytes(const scene::Job& job)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    return map_bytes(job) + scene::map_count(job) * side * side * sizeof(std::uint32_t);
}

LookupTraits primitive_traits(const scene::Job& job)
{
    return {.verdict = Verdict::binary,
            .compares = Compares::primitives,
            .monotonicity = {Monotone::exactly, 0}, // independent of the bias
            .curve = Curve::none,
            .width_texels = 1,
            .weights = Weights::equal,
            .kernel = {},
            .map_bytes = primitive_map_bytes(job)};
}

Passes primitive_passes(const scene::Job& /*job*/)
{
    Passes made;
    made.draws_primitives = true;
    made.lookup = {glsl_source("same_primitive.glsl")};
    return made;
}

} // namespace

Method primitive_map()
{
    return {.name = "primitive_id",
            .sentence =
                "draws which triangle the light sees first, and lights a receiver where its "
                "texel shows the receiver's own",
            .sources = primitive_sources,
            .page = "docs/methods/primitive_id.md",
            .key_tables = primitive_tables,
            .keys = {},
            .filters = {},
            .bias_terms = {},
            .traits = primitive_traits,
            .passes = primitive_passes,
            .check = primitive_check};
}

} // namespace gnomon::methods
