#include "scene/filter.hpp"

#include <algorithm>
#include <array>

namespace gnomon::scene {
namespace {

using Compares = FilterPromises::Compares;
using Weights = FilterPromises::Weights;

constexpr auto table = std::to_array<FilterPromises>({
    {"nearest", 1, Compares::each_tap, Weights::equal},
    {"linear", 2, Compares::mean_depth, Weights::bilinear},
    {"hardware", 2, Compares::each_tap, Weights::bilinear_of_gl},
    {"pcf3", 3, Compares::each_tap, Weights::equal},
    {"pcf5", 5, Compares::each_tap, Weights::equal},
    {"pcf7", 7, Compares::each_tap, Weights::equal},
    {"pcf9", 9, Compares::each_tap, Weights::equal},
});
static_assert(std::ranges::max(table, {}, &FilterPromises::tap_count).tap_count() == most_taps);

} // namespace

std::span<const FilterPromises> filters()
{
    return table;
}

const FilterPromises& promises(Filter filter)
{
    return table.at(static_cast<std::size_t>(filter));
}

std::string_view filter_name(Filter filter)
{
    return promises(filter).name;
}

int filter_width_texels(Filter filter)
{
    return promises(filter).width_texels;
}

} // namespace gnomon::scene
