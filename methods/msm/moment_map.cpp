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

constexpr auto msm_sources = std::to_array<Source>({
    {"C. Peters, R. Klein", 2015, "Moment shadow mapping", {}},
    {"M. Pettineo", 2015, "Shadow sample update", "moment bias of 32-bit floats"},
});
constexpr auto msm_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& moment_bias_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.moment_bias",
                        "share that moments of depths at both ends of the range have; auto: 3e-6, "
                        "and with 16 bits 3e-5",
                        "", scene::only(scene::Stage::lookup)),
        scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true, .or_auto = true},
        std::string{"auto"}, {.values = {3e-7, 3e-5, 3e-4}});
    return key;
}

TexelFormat msm_format(const scene::Job& job)
{
    return is_16_bit(job) ? TexelFormat::rgba16 : TexelFormat::rgba32f;
}

float moment_bias_in(const scene::Job& job)
{
    const auto* const chosen = std::get_if<double>(&moment_bias_key().value_of(job.method));
    const double automatic = is_16_bit(job) ? 3e-5 : 3e-6;
    return static_cast<float>(chosen != nullptr ? *chosen : automatic);
}

Passes msm_passes(const scene::Job& job)
{
    static const std::string rows = with_mean_of_rows(glsl_source("four_moments.glsl"));
    const bool is_reversed = job.shadow_map.frustum.reversed;
    const bool is_quantised = is_16_bit(job);
    const Definition quantised{"QUANTISED", is_quantised ? "1" : "0"};
    Passes made =
        blur_passes(job, mean_of({.rows = rows,
                                  .definitions = {quantised, {"REVERSED", is_reversed ? "1" : "0"}},
                                  .format = msm_format(job)}));
    made.lookup = {glsl_source("hamburger.glsl"), {quantised}, reduction_uniforms(job)};
    made.lookup.uniforms.push_back({"moment_bias", {moment_bias_in(job)}});
    // The moments of depths 0 and 1, after the affine map.
    using Texel = std::array<float, 4>;
    const Texel nearest = is_quantised ? Texel{0.035955884801F, 0, 0, 0} : Texel{0, 0, 0, 0};
    const Texel farthest =
        is_quantised ? Texel{0.99999999F, 0.99755993F, 0.89343751F, 0} : Texel{1, 1, 1, 1};
    made.of_ends = is_reversed ? std::array{farthest, nearest} : std::array{nearest, farthest};
    return made;
}

/// No curve: with rounded moments the verdict sometimes falls when the bias grows.
LookupTraits msm_traits(const scene::Job& job)
{
    LookupTraits promised = blur_traits(job, msm_format(job));
    promised.monotonicity = {Monotone::no, 0};
    promised.curve = Curve::none;
    return promised;
}

std::vector<Key> msm_keys()
{
    std::vector<Key> keys = blur_keys();
    keys.insert(keys.begin(), {bits_key(), moment_bias_key()});
    keys.push_back(reduction_key());
    return keys;
}

} // namespace

Method moment_map()
{
    return {.name = "msm",
            .sentence = "keeps four moments of depths, and bounds by them how much of the light "
                        "gets through",
            .sources = msm_sources,
            .page = "docs/methods/msm.md",
            .key_tables = msm_tables,
            .keys = msm_keys(),
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = msm_traits,
            .passes = msm_passes,
            .check = check_blur};
}

} // namespace gnomon::methods
