#include "methods/all_methods.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/glsl.hpp"
#include "methods/taps/tap_kernel.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>

namespace gnomon::methods {
namespace {

using scene::Key;
using scene::Stage;

constexpr auto pcf_sources = std::to_array<Source>({
    {"W. T. Reeves, D. H. Salesin, R. L. Cook",
     1987,
     "Rendering antialiased shadows with depth maps",
     {}},
    {"H. Vogel", 1979, "A better way to construct the sunflower head", "the spiral"},
    {"D. P. Mitchell", 1991, "Spectrally optimal sampling for distribution ray tracing",
     "Poisson discs by best candidates"},
    {"J. R. Isidoro", 2006, "Shadow mapping: GPU-based tips and techniques",
     "kernels that are turned at each pixel"},
});
constexpr auto pcf_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

const Key& radius_texels_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.radius_texels", "radius of the kernel [{unit}]",
                                         "", scene::only(Stage::lookup), "texels"),
                         scene::RealDomain{.lower = 0.25, .upper = largest_radius_texels}, 2.0,
                         {.values = {1.0, 1.5, 3.0, 4.0}});
    return key;
}
const Key& radius_m_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.radius_m",
                        "the same at the receiver [{unit}], but at most 64 texels; 0: "
                        "radius_texels says it",
                        "", scene::only(Stage::lookup), "m"),
        scene::RealDomain{.lower = 0, .upper = 1000, .normal_float = true}, 0.0);
    return key;
}
const Key& weights_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.weights",
                        "how much taps count: all the same, or falling from the middle", "",
                        scene::only(Stage::lookup)),
        scene::WordDomain{.words = {"equal", "tent", "gaussian"}}, std::string{"equal"},
        {.values = {std::string{"tent"}, std::string{"gaussian"}}});
    return key;
}

const Key& tap_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.tap",
                        "what a tap is: the texel that it lies in, or the four nearest, each "
                        "compared and mixed bilinearly as a comparison sampler does",
                        "", scene::only(Stage::lookup)),
        scene::WordDomain{.words = {"texel", "bilinear"}}, std::string{"texel"},
        {.values = {std::string{"bilinear"}}});
    return key;
}

double pcf_number(const Key& key, const scene::Job& job)
{
    return std::get<double>(key.value_of(job.method));
}

TapWeights tap_weights(const scene::Job& job)
{
    const auto& word = std::get<std::string>(weights_key().value_of(job.method));
    return word == "equal"  ? TapWeights::equal
           : word == "tent" ? TapWeights::tent
                            : TapWeights::gaussian;
}

bool has_bilinear_taps(const scene::Job& job)
{
    return std::get<std::string>(tap_key().value_of(job.method)) == "bilinear";
}

void pcf_check(const scene::Job& job)
{
    check_taps(job);
    constexpr int most_bilinear = static_cast<int>(most_taps) / 4;
    if (const int taps = tap_count(job); has_bilinear_taps(job) && taps > most_bilinear) {
        throw scene::InputError(
            fmt::format("method.taps = {}: method.tap = \"bilinear\" allows at most {}, because "
                        "each reads four texels; use fewer, or method.tap = \"texel\"",
                        taps, most_bilinear));
    }
    if (pcf_number(radius_m_key(), job) > 0 && scene::mixes_maps(job)) {
        throw scene::InputError(
            "method.radius_m: a radius in metres differs between two maps that are blended; use "
            "method.radius_texels, or remove shadow_map.blend");
    }
}

ScatteredTaps taps_of(const scene::Job& job)
{
    const TapKernel& kernel = tap_kernel(job, tap_weights(job));
    const double radius_m = pcf_number(radius_m_key(), job);
    const double radius_texels = pcf_number(radius_texels_key(), job);
    return {.places = kernel.places,
            .weights = kernel.weights,
            .are_interpolated = has_bilinear_taps(job),
            .radius = radius_m > 0 ? radius_m : radius_texels,
            .is_in_metres = radius_m > 0,
            .is_turned = is_turned(job)};
}

LookupTraits pcf_traits(const scene::Job& job)
{
    const ScatteredTaps taps = taps_of(job);
    const bool is_equal = taps.weights.empty() && !taps.are_interpolated;
    return {.verdict = Verdict::fraction,
            .compares = Compares::each_tap,
            .monotonicity = {Monotone::exactly, 0},
            .curve = is_equal ? Curve::by_formula : Curve::by_bisection,
            .width_texels = width_of_radius((taps.is_in_metres ? 1 : taps.radius) +
                                            (taps.are_interpolated ? 0.5 : 0)),
            .weights = is_equal ? Weights::equal : Weights::of_taps,
            .kernel = {},
            .taps = taps,
            .map_bytes = map_bytes(job)};
}

Passes pcf_passes(const scene::Job& job)
{
    const auto weights = taps_of(job).weights;
    Passes made;
    made.lookup = {glsl_source("scattered_comparisons.glsl"),
                   {{"WEIGHTED", weights.empty() ? "0" : "1"},
                    {"BILINEAR_TAPS", has_bilinear_taps(job) ? "1" : "0"}},
                   {}};
    if (!weights.empty()) {
        made.lookup.uniforms.push_back({"tap_weights", {weights.begin(), weights.end()}});
    }
    return made;
}

} // namespace

Method percentage_closer()
{
    return {.name = "pcf",
            .sentence = "compares with texels that a kernel of any radius scatters about the "
                        "receiver's, and takes the mean",
            .sources = pcf_sources,
            .page = "docs/methods/pcf.md",
            .key_tables = pcf_tables,
            .keys = {pattern_key(), radius_texels_key(), radius_m_key(), taps_key(), weights_key(),
                     turned_key(), tap_key()},
            .filters = {},
            .bias_terms = bias_terms(),
            .traits = pcf_traits,
            .passes = pcf_passes,
            .check = pcf_check};
}

} // namespace gnomon::methods
