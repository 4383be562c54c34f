#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/glsl.hpp"
#include "methods/prefiltered/blur.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto evsm_sources = std::to_array<Source>({
    {"A. Lauritzen, M. McCool", 2008, "Layered variance shadow maps", "both warps"},
    {"M. Pettineo", 2013, "A sampling of shadow techniques",
     "exponents, least variance in parts of the warp"},
});
constexpr auto evsm_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& moments_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.moments", "{unit} of a texel: 2 of the positive warp, or 4 of both",
                        "", Stage::prefilter | Stage::lookup, "moments"),
        scene::IntegerDomain{.lower = 2, .upper = 4, .is_power_of_two = true}, std::int64_t{4},
        {.values = {std::int64_t{2}}});
    return key;
}

const scene::RealDomain& exponent_domain()
{
    static const scene::RealDomain domain{.lower = 1, .upper = 100, .or_auto = true};
    return domain;
}

const Key& positive_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.positive_exponent",
                        "c of the positive warp e^(c · (2z − 1)) [{unit}]; auto: 40, and with 16 "
                        "bits 5.54",
                        "", Stage::prefilter | Stage::lookup, "per half of the depth range"),
        exponent_domain(), std::string{"auto"}, {.values = {5.0, 10.0, 20.0}});
    return key;
}
const Key& negative_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.negative_exponent",
                        "c of the negative warp −e^(−c · (2z − 1)) [{unit}]; auto: 5", "",
                        Stage::prefilter | Stage::lookup, "per half of the depth range"),
        exponent_domain(), std::string{"auto"}, {.values = {2.5, 10.0, 20.0}});
    return key;
}

const Key& deviation_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.min_deviation",
                        "least standard deviation of the depths [{unit}]; auto: 1e-4, and with 16 "
                        "bits 1e-3",
                        "", scene::only(Stage::lookup), "depth units"),
        scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true, .or_auto = true},
        std::string{"auto"}, {.values = {1e-5, 1e-3}});
    return key;
}

/// Largest exponent whose squared warp, e^(2c), fits: half the logarithm of 65504, the largest
/// 16-bit float. With 32 bits, half that of an eighth of the largest float, because the shader adds
/// up to 8 values.
double largest_exponent(const scene::Job& job)
{
    return is_16_bit(job) ? 5.54 : 43.32;
}

double chosen_or(const scene::Job& job, const Key& key, double automatic)
{
    const auto* const chosen = std::get_if<double>(&key.value_of(job.method));
    return chosen != nullptr ? *chosen : automatic;
}

/// The exponents of the positive and the negative warp.
std::array<double, 2> exponents_in(const scene::Job& job)
{
    return {chosen_or(job, positive_key(), is_16_bit(job) ? largest_exponent(job) : 40),
            chosen_or(job, negative_key(), 5)};
}

bool has_both_warps(const scene::Job& job)
{
    return value_in<std::int64_t>(job, moments_key()) == 4;
}

TexelFormat evsm_format(const scene::Job& job)
{
    if (has_both_warps(job)) {
        return is_16_bit(job) ? TexelFormat::rgba16f : TexelFormat::rgba32f;
    }
    return is_16_bit(job) ? TexelFormat::rg16f : TexelFormat::rg32f;
}

/// The texel of the depth range's end at y.
std::array<float, 4> warped_end(const std::array<double, 2>& exponents, double y)
{
    const double positive = std::exp(exponents[0] * y);
    const double negative = std::exp(-exponents[1] * y);
    return {static_cast<float>(positive), static_cast<float>(positive * positive),
            static_cast<float>(negative), static_cast<float>(negative * negative)};
}

Passes evsm_passes(const scene::Job& job)
{
    static const std::string rows = with_exponential(with_mean_of_rows(
        fmt::format("{}{}", glsl_source("warp.glsl"), glsl_source("warped_moments.glsl"))));
    static const std::string lookup = with_exponential(
        fmt::format("{}{}", glsl_source("warp.glsl"), glsl_source("warped_chebyshev.glsl")));
    const bool is_reversed = job.shadow_map.frustum.reversed;
    const std::array<double, 2> exponents = exponents_in(job);
    const Uniform warps{"exponents",
                        {static_cast<float>(exponents[0]), static_cast<float>(exponents[1])}};
    const Definition moments{"MOMENTS", has_both_warps(job) ? "4" : "2"};
    Passes made = blur_passes(
        job,
        mean_of(
            {rows, {moments, {"REVERSED", is_reversed ? "1" : "0"}}, {warps}, evsm_format(job)}));
    made.lookup = {lookup, {moments}, reduction_uniforms(job)};
    made.lookup.uniforms.push_back(warps);
    // The derivative of a warp is 2c times its value.
    const double deviation = chosen_or(job, deviation_key(), is_16_bit(job) ? 1e-3 : 1e-4);
    Uniform least{"least_variance", {}};
    for (const double exponent : exponents) {
        const double share = 2 * exponent * deviation;
        least.values.push_back(static_cast<float>(share * share));
    }
    made.lookup.uniforms.push_back(least);
    made.of_ends = {warped_end(exponents, is_reversed ? 1 : -1),
                    warped_end(exponents, is_reversed ? -1 : 1)};
    return made;
}

LookupTraits evsm_traits(const scene::Job& job)
{
    return blur_traits(job, evsm_format(job));
}

std::vector<Key> evsm_keys()
{
    std::vector<Key> keys = blur_keys();
    keys.insert(keys.begin(), {moments_key(), bits_key(), positive_key(), negative_key()});
    keys.push_back(reduction_key());
    keys.push_back(deviation_key());
    return keys;
}

void check_exponent(const scene::Job& job, const Key& key, double exponent)
{
    if (exponent > largest_exponent(job)) {
        throw scene::InputError(fmt::format(
            "{} = {}: the square of e^{} overflows {}; use {} or less{}", key.name, exponent,
            exponent, is_16_bit(job) ? "16-bit floats" : "sums of 32-bit floats",
            largest_exponent(job), is_16_bit(job) ? ", or method.bits = 32" : ""));
    }
}

void evsm_check(const scene::Job& job)
{
    check_blur(job);
    const std::array<double, 2> exponents = exponents_in(job);
    check_exponent(job, positive_key(), exponents[0]);
    if (has_both_warps(job)) {
        check_exponent(job, negative_key(), exponents[1]);
    }
}

} // namespace

Method exponential_variance_map()
{
    return {.name = "evsm",
            .sentence = "keeps means and variances of depths warped by exponentials, and bounds by "
                        "them how much of the light gets through",
            .sources = evsm_sources,
            .page = "docs/methods/evsm.md",
            .key_tables = evsm_tables,
            .keys = evsm_keys(),
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = evsm_traits,
            .passes = evsm_passes,
            .check = evsm_check};
}

} // namespace gnomon::methods
