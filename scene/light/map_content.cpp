#include "scene/light/map_content.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon::scene {
namespace {

constexpr auto content_table = std::to_array<MapContentTraits>({
    {.content = MapContent::depth,
     .name = "depth",
     .noun = "depth",
     .measure = Measure::clip_depth,
     .from_near = true},
    {.content = MapContent::distance,
     .name = "distance",
     .meaning = "the distance to it, over far",
     .noun = "distances",
     .why_positional = "a directional light is nowhere, and has no distances",
     .shader_line = "distance(P, L) / far",
     .measure = Measure::ray,
     .from_near = false},
    {.content = MapContent::linear,
     .name = "linear",
     .meaning = "its light distance, linear from near to far",
     .noun = "linear depth",
     .why_positional = "a directional light's depth is linear already",
     .shader_line = "(w - near) / (far - near), w the clip position's",
     .measure = Measure::axis,
     .from_near = true},
});

/// Whether the row of each content stands where its enumerator counts.
constexpr bool follows_enumerators()
{
    for (std::size_t i = 0; i < content_table.size(); ++i) {
        if (content_table[i].content != static_cast<MapContent>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(follows_enumerators(), "each content needs its row, in the order of the enumerators");
static_assert(std::ranges::none_of(content_table,
                                   [](const MapContentTraits& content) {
                                       return content.measure == Measure::ray && content.from_near;
                                   }),
              "exact distances are roots of fractions, from which no near is taken");

} // namespace

DepthRange MapContentTraits::stored_range(const DepthRange& drawn) const
{
    return is_gl_depth() ? drawn
                         : DepthRange{Projection::orthographic, from_near ? drawn.near_m : 0,
                                      drawn.far_m, false, ClipRange::zero_to_one};
}

std::span<const MapContentTraits> map_contents()
{
    return content_table;
}

const MapContentTraits& traits_of(MapContent content)
{
    return content_table.at(static_cast<std::size_t>(content));
}

std::string_view map_content_name(MapContent content)
{
    return traits_of(content).name;
}

std::optional<MapContent> map_content_from_name(std::string_view name)
{
    const auto found = std::ranges::find(content_table, name, &MapContentTraits::name);
    return found == content_table.end() ? std::nullopt : std::optional{found->content};
}

} // namespace gnomon::scene
