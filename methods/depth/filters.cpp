#include "methods/depth/filters.hpp"

#include <algorithm>
#include <array>

namespace gnomon::methods {
namespace {

using scene::Filter;

constexpr Rises always{Rise::exactly, 0};

/// The mean of comparisons with width × width texels, fetched one by one.
constexpr FilterPromises mean_of_comparisons(Filter filter, int width_texels,
                                             std::string_view sentence)
{
    return {filter,  width_texels,      Compares::each_tap, Weights::equal,
            always,  Curve::by_formula, Sampling::fetched,  "mean_of_comparisons.glsl",
            sentence};
}

constexpr auto filter_table = std::to_array<FilterPromises>({
    mean_of_comparisons(Filter::nearest, 1, "compares with the texel that holds the receiver"),
    {Filter::linear, 2, Compares::mean_depth, Weights::bilinear, always, Curve::by_formula,
     Sampling::interpolated, "interpolated_depth.glsl",
     "interpolates the depths of 2 × 2 texels, and compares once"},
    {Filter::hardware, 2, Compares::each_tap, Weights::bilinear_of_gl, always, Curve::by_bisection,
     Sampling::compared, "compared_by_gl.glsl",
     "GL's own filter: compares with 2 × 2 texels, and interpolates the answers"},
    mean_of_comparisons(Filter::pcf3, 3, "the mean of the comparisons with 3 × 3 texels"),
    mean_of_comparisons(Filter::pcf5, 5, "the mean of the comparisons with 5 × 5 texels"),
    mean_of_comparisons(Filter::pcf7, 7, "the mean of the comparisons with 7 × 7 texels"),
    mean_of_comparisons(Filter::pcf9, 9, "the mean of the comparisons with 9 × 9 texels"),
});

/// Whether the row of each filter stands where its enumerator counts.
constexpr bool follows_enumerators()
{
    for (std::size_t i = 0; i < filter_table.size(); ++i) {
        if (filter_table[i].filter != static_cast<Filter>(i)) {
            return false;
        }
    }
    return filter_table.size() == scene::filter_count;
}
static_assert(follows_enumerators(), "each filter needs its row, in the order of the enumerators");
static_assert(std::ranges::max(filter_table, {}, &FilterPromises::tap_count).tap_count() ==
              most_taps);

} // namespace

std::span<const FilterPromises> filters()
{
    return filter_table;
}

const FilterPromises& filter_promises(Filter filter)
{
    return filter_table.at(static_cast<std::size_t>(filter));
}

} // namespace gnomon::methods
