#include "scene/light/frustum.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

/// high − low. On a grid of texels it is a float32, which the difference misses by a rounding that
/// depends on where the map lies.
double width_of(const LightFrustum& frustum, double low, double high)
{
    const double width = high - low;
    return frustum.grid_texels > 0 ? double{static_cast<float>(width)} : width;
}

/// A translation in clip space, moved to the next multiple of a texel's width there.
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
