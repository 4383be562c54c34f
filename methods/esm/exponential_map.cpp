#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/glsl.hpp"
#include "methods/prefiltered/blur.hpp"
#include "scene/job/keys/key.hpp"

#include <array>
#include <string>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto esm_sources = std::to_array<Source>({
    {"T. Annen, T. Mertens, H.-P. Seidel, E. Flerackers, J. Kautz",
     2008,
     "Exponential shadow maps",
     {}},
    {"M. Salvi", 2008, "Rendering filtered shadows with exponential shadow maps (ShaderX 6)",
     "means in log space"},
});
constexpr auto esm_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& exponent_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.exponent", "c of e^(c · depth) [{unit}]", "",
                                         Stage::prefilter | Stage::lookup, "per depth range"),
                         scene::RealDomain{.lower = 1, .upper = 10000}, 80.0,
                         {.values = {20.0, 40.0, 160.0, 320.0}});
    return key;
}

TexelFormat esm_format(const scene::Job& job)
{
    return is_16_bit(job) ? TexelFormat::r16f : TexelFormat::r32f;
}

/// The mean along rows or columns.
GlslSnippet mean_along(const scene::Job& job, const std::string& direction, const Uniform& exponent)
{
    static const std::string glsl = with_exponential(glsl_source("exponential_mean.glsl"));
    return {glsl,
            {{"ALONG", direction}, {"REVERSED", job.shadow_map.frustum.reversed ? "1" : "0"}},
            {exponent}};
}

Passes esm_passes(const scene::Job& job)
{
    static const std::string lookup = with_exponential(glsl_source("exponential_test.glsl"));
    const Uniform exponent{"exponent", {static_cast<float>(value_in<double>(job, exponent_key()))}};
    Passes made = blur_passes(job, {mean_along(job, "ivec2(1, 0)", exponent),
                                    mean_along(job, "ivec2(0, 1)", exponent), esm_format(job)});
    made.lookup = {lookup, {}, {exponent}};
    return made;
}

LookupTraits esm_traits(const scene::Job& job)
{
    return blur_traits(job, esm_format(job));
}

std::vector<Key> esm_keys()
{
    std::vector<Key> keys = blur_keys();
    keys.insert(keys.begin(), {exponent_key(), bits_key()});
    return keys;
}

} // namespace

Method exponential_map()
{
    return {.name = "esm",
            .sentence = "keeps the mean of the depths' exponentials, and weakens the light "
                        "exponentially with how far the receiver is behind it",
            .sources = esm_sources,
            .page = "docs/methods/esm.md",
            .key_tables = esm_tables,
            .keys = esm_keys(),
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = esm_traits,
            .passes = esm_passes,
            .check = check_blur};
}

} // namespace gnomon::methods
