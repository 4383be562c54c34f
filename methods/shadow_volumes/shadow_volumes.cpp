#include "methods/all_methods.hpp"

#include "scene/job/keys/key.hpp"

#include <array>
#include <string>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto volume_sources = std::to_array<Source>({
    {"F. C. Crow", 1977, "Shadow algorithms for computer graphics", {}},
    {"C. Everitt, M. J. Kilgard", 2002,
     "Practical and robust stenciled shadow volumes for hardware-accelerated rendering",
     "counted behind receivers (z-fail), volumes without end"},
    {"B. Kim, K. Kim, G. Turk", 2008,
     "A shadow-volume algorithm for opaque and transparent nonmanifold casters",
     "silhouettes that count, of any mesh"},
});

const Key& extrusion_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.extrusion", "the edges that volumes have sides at",
                                         "", scene::only(Stage::lookup)),
                         scene::WordDomain{.words = {"silhouette", "triangle"}},
                         std::string{"silhouette"}, {.values = {std::string{"triangle"}}});
    return key;
}
const Key& casters_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.casters", "the triangles that have volumes", "",
                                         scene::only(Stage::lookup)),
                         scene::WordDomain{.words = {"all", "facing_light"}}, std::string{"all"},
                         {.values = {std::string{"facing_light"}}});
    return key;
}

Casters casters_of(const scene::Job& job)
{
    return std::get<std::string>(casters_key().value_of(job.method)) == "all"
               ? Casters::all
               : Casters::facing_light;
}

LookupTraits volume_traits(const scene::Job& job)
{
    return {.verdict = Verdict::binary,
            .compares = Compares::none,
            .monotonicity = {Monotone::exactly, 0}, // independent of the bias
            .curve = Curve::none,
            .kernel = {},
            .has_map = false,
            .casters = casters_of(job)};
}

Passes volume_passes(const scene::Job& job)
{
    const bool is_silhouette =
        std::get<std::string>(extrusion_key().value_of(job.method)) == "silhouette";
    Passes made;
    made.volumes = {is_silhouette ? Extrusion::silhouette : Extrusion::triangle, casters_of(job)};
    return made;
}

} // namespace

Method shadow_volumes()
{
    return {.name = "shadow_volumes",
            .sentence =
                "counts, at each receiver, the volumes that casters shadow, in the stencil of "
                "the camera's view",
            .sources = volume_sources,
            .page = "docs/methods/shadow_volumes.md",
            .key_tables = {},
            .keys = {extrusion_key(), casters_key()},
            .filters = {},
            .bias_terms = {},
            .traits = volume_traits,
            .passes = volume_passes};
}

} // namespace gnomon::methods
