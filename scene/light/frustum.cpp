#include "scene/light/frustum.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::scene {
namespace {

Vec2d perspective_row(double n, double f, bool reversed, bool zero_to_one)
{
    if (zero_to_one) {
        return reversed ? Vec2d{-n / (f - n), n * f / (f - n)}
                        : Vec2d{f / (f - n), -f * n / (f - n)};
    }
    const Vec2d standard{(f + n) / (f - n), -2.0 * f * n / (f - n)};
    return reversed ? -standard : standard;
}

Vec2d orthographic_row(double n, double f, bool reversed, bool zero_to_one)
{
    if (zero_to_one) {
        return reversed ? Vec2d{-1.0 / (f - n), f / (f - n)} : Vec2d{1.0 / (f - n), -n / (f - n)};
    }
    const Vec2d standard{2.0 / (f - n), -(f + n) / (f - n)};
    return reversed ? -standard : standard;
}

} // namespace

Vec2d clip_depth_row(const DepthRange& range)
{
    const bool zero_to_one = range.clip_range == ClipRange::zero_to_one;
    return range.projection == Projection::perspective
               ? perspective_row(range.near_m, range.far_m, range.reversed, zero_to_one)
               : orthographic_row(range.near_m, range.far_m, range.reversed, zero_to_one);
}

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

/// Whether the rows follow the order of the enumerators.
constexpr bool contents_follow_enumerators()
{
    for (std::size_t i = 0; i < content_table.size(); ++i) {
        if (content_table[i].content != static_cast<MapContent>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(contents_follow_enumerators(),
              "each content needs its row, in the order of the enumerators");
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

namespace {

/// high − low. On a texel grid the true width is a float32; rounding restores it, because the error
/// of the difference depends on the map's position.
double width_of(const LightFrustum& frustum, double low, double high)
{
    const double width = high - low;
    return frustum.grid_texels > 0 ? double{static_cast<float>(width)} : width;
}

/// A translation in clip space, rounded to a multiple of a texel's width.
double on_grid(double translation, int texels)
{
    return texels > 0 ? std::round(translation * texels / 2) * 2 / texels : translation;
}

} // namespace

ClipRange clip_range_of(const FrustumSettings& settings)
{
    return settings.clip_range.value_or(settings.reversed ? ClipRange::zero_to_one
                                                          : ClipRange::minus_one_to_one);
}

double LightFrustum::largest_per_light_distance() const
{
    return traits_of(content).measure == Measure::ray ? glm::length(Vec3d{right_side, top, 1}) : 1;
}

void compose_matrix(LightFrustum& f)
{
    const bool perspective = f.projection == Projection::perspective;
    const auto affine = [&](const Vec3d& axis) { return Vec4d{axis, -glm::dot(axis, f.origin)}; };
    const Vec4d light_distance = affine(f.forward);
    const Vec4d w = perspective ? light_distance : Vec4d{0, 0, 0, 1};
    const auto side = [&](const Vec3d& axis, double low, double high) {
        Vec4d row = (2.0 * affine(axis) - (high + low) * w) / width_of(f, low, high);
        row.w = on_grid(row.w, f.grid_texels);
        return row;
    };
    const Vec2d depth = clip_depth_row(f.depth_range());
    const Vec4d z = depth.x * light_distance + Vec4d{0, 0, 0, depth.y};
    f.light_clip_from_world_exact = glm::transpose(
        Mat4d{side(f.right, f.left, f.right_side), side(f.up, f.bottom, f.top), z, w});
    f.light_clip_from_world = Mat4f{f.light_clip_from_world_exact};
}

double LightFrustum::light_distance_m(const Vec3d& point) const
{
    return glm::dot(forward, point - origin);
}

double LightFrustum::texel_width_m(double light_distance_m, int resolution_texels) const
{
    const double side = std::max(right_side - left, top - bottom) / resolution_texels;
    return projection == Projection::perspective ? side * light_distance_m : side;
}

} // namespace gnomon::scene
