#include "methods/depth/depth_map.hpp"

#include "methods/depth/terms/constant.hpp"
#include "methods/depth/terms/normal_offset.hpp"
#include "methods/depth/terms/plane_gradient.hpp"
#include "methods/depth/terms/polygon_offset.hpp"
#include "methods/depth/terms/receiver_plane.hpp"
#include "methods/depth/terms/texel_bias.hpp"
#include "methods/glsl.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::methods {
namespace {

constexpr auto term_table = std::to_array<BiasTerm>({
    constant_bias,
    slope_bias,
    normal_offset,
    normal_length,
    texel_bias,
    polygon_offset,
    kernel_slope,
    adaptive_bias,
    receiver_plane,
});

} // namespace

std::span<const BiasTerm> bias_terms()
{
    return term_table;
}

namespace {

using scene::Filter;

constexpr Monotonicity always{Monotone::exactly, 0};

/// The description of a filter.
struct FilterRow {
    FilterChoice choice;
    LookupTraits traits;
    Sampling sampling = Sampling::fetched;
    std::string_view glsl; ///< a name for `glsl_source`
};

/// The mean of comparisons with width × width texels, fetched one by one.
constexpr FilterRow mean_of_comparisons(Filter filter, int width_texels, std::string_view sentence)
{
    return {{filter, sentence},
            {.verdict = width_texels > 1 ? Verdict::fraction : Verdict::binary,
             .compares = Compares::each_tap,
             .monotonicity = always,
             .curve = Curve::by_formula,
             .width_texels = width_texels,
             .weights = Weights::equal,
             .kernel = {}},
            Sampling::fetched,
            "mean_of_comparisons.glsl"};
}

/// Integer weights that approximate a Gaussian, as common in gather filters.
constexpr std::array<float, 3> weights3{1, 2, 1};
constexpr std::array<float, 5> weights5{1, 3, 4, 3, 1};
constexpr std::array<float, 7> weights7{1, 5, 12, 16, 12, 5, 1};

/// Interpolates the kernels' means of comparisons around the four nearest centres.
constexpr FilterRow interpolated_comparisons(Filter filter, std::span<const float> weights,
                                             std::string_view sentence)
{
    return {{filter, sentence},
            {.verdict = Verdict::fraction,
             .compares = Compares::each_tap,
             .monotonicity = always,
             .curve = Curve::by_bisection,
             .width_texels = static_cast<int>(weights.size()) + 1,
             .weights = Weights::bilinear,
             .kernel = {weights}},
            Sampling::fetched,
            "interpolated_comparisons.glsl"};
}

constexpr auto filter_table = std::to_array<FilterRow>({
    mean_of_comparisons(Filter::nearest, 1, "compares with the texel that holds the receiver"),
    {{Filter::linear, "interpolates the depths of 2 × 2 texels, and compares once"},
     {.verdict = Verdict::binary,
      .compares = Compares::mean_depth,
      .monotonicity = always,
      .curve = Curve::by_formula,
      .width_texels = 2,
      .weights = Weights::bilinear,
      .kernel = {}},
     Sampling::interpolated,
     "interpolated_depth.glsl"},
    {{Filter::hardware,
      "GL's own filter: compares with 2 × 2 texels, and interpolates the answers"},
     {.verdict = Verdict::fraction,
      .compares = Compares::each_tap,
      .monotonicity = always,
      .curve = Curve::by_bisection,
      .width_texels = 2,
      .weights = Weights::bilinear_of_gl,
      .kernel = {}},
     Sampling::compared,
     "compared_by_gl.glsl"},
    mean_of_comparisons(Filter::pcf3, 3, "the mean of the comparisons with 3 × 3 texels"),
    mean_of_comparisons(Filter::pcf5, 5, "the mean of the comparisons with 5 × 5 texels"),
    mean_of_comparisons(Filter::pcf7, 7, "the mean of the comparisons with 7 × 7 texels"),
    mean_of_comparisons(Filter::pcf9, 9, "the mean of the comparisons with 9 × 9 texels"),
    interpolated_comparisons(Filter::bilinear3, weights3,
                             "gathers comparisons with 4 × 4 texels, and interpolates their means "
                             "over 3 × 3, weighted 1 2 1 along each side"),
    interpolated_comparisons(Filter::bilinear5, weights5,
                             "gathers comparisons with 6 × 6 texels, and interpolates their means "
                             "over 5 × 5, weighted 1 3 4 3 1 along each side"),
    interpolated_comparisons(Filter::bilinear7, weights7,
                             "gathers comparisons with 8 × 8 texels, and interpolates their means "
                             "over 7 × 7, weighted 1 5 12 16 12 5 1 along each side"),
});

/// Whether the rows follow the order of the enumerators.
constexpr bool follows_enumerators()
{
    for (std::size_t i = 0; i < filter_table.size(); ++i) {
        if (filter_table[i].choice.filter != static_cast<Filter>(i)) {
            return false;
        }
    }
    return filter_table.size() == scene::filter_count;
}
static_assert(follows_enumerators(), "each filter needs its row, in the order of the enumerators");
static_assert(std::ranges::all_of(filter_table, [](const FilterRow& row) {
    return row.traits.tap_count() <= most_taps;
}));

constexpr auto choice_table = [] {
    std::array<FilterChoice, filter_table.size()> choices;
    std::ranges::transform(filter_table, choices.begin(), &FilterRow::choice);
    return choices;
}();

const FilterRow& row_of(Filter filter)
{
    return filter_table.at(static_cast<std::size_t>(filter));
}

} // namespace

std::span<const FilterChoice> filters()
{
    return choice_table;
}

const LookupTraits& filter_traits(Filter filter)
{
    return row_of(filter).traits;
}

Passes filter_passes(Filter filter)
{
    const FilterRow& row = row_of(filter);
    GlslSnippet lookup{glsl_source(row.glsl)};
    if (const auto weights = row.traits.kernel.weights; !weights.empty()) {
        lookup.uniforms.push_back({"kernel", {weights.begin(), weights.end()}});
    }
    return {.prefilter = {}, .lookup = std::move(lookup), .sampling = row.sampling};
}

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
        // Each tap has its own reference depth, which no formula covers.
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

/// Bytes of a texel in the smallest GL format that holds it; u-formats as if GL had them.
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
