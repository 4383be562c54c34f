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

constexpr auto vsm_sources = std::to_array<Source>({
    {"W. Donnelly, A. Lauritzen", 2006, "Variance shadow maps", {}},
    {"A. Lauritzen", 2007, "Summed-area variance shadow maps (GPU Gems 3, chapter 8)",
     "least variance, reduction of light bleeding"},
});
constexpr auto vsm_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& content_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.content", "what the moments are stored as", "",
                        scene::only(scene::Stage::prefilter)),
        scene::WordDomain{.words = {"rg16", "rg16f", "rg32f"}}, std::string{"rg32f"},
        {.values = {std::string{"rg16"}, std::string{"rg16f"}}});
    return key;
}

const Key& variance_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.min_variance", "least variance of the depths [{unit}]", "",
                        scene::only(scene::Stage::lookup), "depth units squared"),
        scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true}, 1e-6,
        {.values = {1e-7, 1e-5, 1e-4}});
    return key;
}

TexelFormat vsm_format(const scene::Job& job)
{
    const auto content = value_in<std::string>(job, content_key());
    return content == "rg16"    ? TexelFormat::rg16
           : content == "rg16f" ? TexelFormat::rg16f
                                : TexelFormat::rg32f;
}

Passes vsm_passes(const scene::Job& job)
{
    static const std::string rows = with_mean_of_rows(glsl_source("moments.glsl"));
    Passes made = blur_passes(job, mean_of({.rows = rows, .format = vsm_format(job)}));
    made.lookup = {glsl_source("chebyshev.glsl"), {}, reduction_uniforms(job)};
    made.lookup.uniforms.push_back(
        {"min_variance", {static_cast<float>(value_in<double>(job, variance_key()))}});
    return made;
}

LookupTraits vsm_traits(const scene::Job& job)
{
    return blur_traits(job, vsm_format(job));
}

std::vector<Key> vsm_keys()
{
    std::vector<Key> keys = blur_keys();
    keys.insert(keys.begin(), content_key());
    keys.push_back(reduction_key());
    keys.push_back(variance_key());
    return keys;
}

} // namespace

Method variance_map()
{
    return {.name = "vsm",
            .sentence = "keeps mean and variance of depths, and bounds by them how much of the "
                        "light gets through",
            .sources = vsm_sources,
            .page = "docs/methods/vsm.md",
            .key_tables = vsm_tables,
            .keys = vsm_keys(),
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = vsm_traits,
            .passes = vsm_passes,
            .check = check_blur};
}

} // namespace gnomon::methods
