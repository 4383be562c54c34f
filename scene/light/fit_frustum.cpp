#include "scene/light/fit_frustum.hpp"

#include "scene/camera/clip.hpp"
#include "scene/error.hpp"
#include "scene/light/near_far.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace gnomon::scene {
namespace {

/// Cosine and sine of an angle; exact for quarter turns.
Vec2d turn_by(double angle_deg)
{
    const double quarters = angle_deg / 90;
    if (quarters != std::round(quarters)) {
        return {std::cos(glm::radians(angle_deg)), std::sin(glm::radians(angle_deg))};
    }
    constexpr std::array<std::array<double, 2>, 4> turns{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto& turn = turns.at(static_cast<std::size_t>(static_cast<int>(quarters) & 3));
    return {turn[0], turn[1]};
}

void set_axes(LightFrustum& frustum, const Vec3d& direction, double roll_deg)
{
    frustum.forward = glm::normalize(direction);
    const Vec3d world_up{0, 1, 0};
    const bool vertical = glm::length(glm::cross(frustum.forward, world_up)) < 1e-3;
    const Vec3d hint = vertical ? Vec3d{0, 0, 1} : world_up;
    const Vec3d right = glm::normalize(glm::cross(frustum.forward, hint));
    const Vec3d up = glm::cross(right, frustum.forward);
    const Vec2d roll = turn_by(roll_deg);
    frustum.right = roll.x * right + roll.y * up;
    frustum.up = roll.x * up - roll.y * right;
}

Vec3d camera_position(const LightSettings& settings, const Light& light, const Box& box)
{
    if (light.has_cone()) {
        return light.position;
    }
    return settings.position ? rounded_to_float32(*settings.position) : box.centre();
}

} // namespace

LightFrustum place_light_camera(const FrustumSettings& settings,
                                const LightSettings& light_settings, const Light& light,
                                const Box& box)
{
    LightFrustum frustum;
    frustum.projection = light.has_cone() ? Projection::perspective : Projection::orthographic;
    frustum.content = settings.content;
    frustum.reversed = settings.reversed;
    frustum.clip_range = clip_range_of(settings);
    frustum.origin = camera_position(light_settings, light, box);
    set_axes(frustum, light.direction, settings.roll_deg);
    return frustum;
}

Vec3d in_light_view(const LightFrustum& frustum, const Vec3d& point)
{
    const Vec3d q = point - frustum.origin;
    return {glm::dot(frustum.right, q), glm::dot(frustum.up, q), glm::dot(frustum.forward, q)};
}

namespace {

/// Extent of points in light view: right, up, forward coordinates and the tangents seen from the
/// origin.
struct LightViewExtent {
    Vec3d lower{std::numeric_limits<double>::infinity()};
    Vec3d upper{-std::numeric_limits<double>::infinity()};
    double largest_tangent = 0;

    void include(const LightFrustum& frustum, const Vec3d& point)
    {
        const Vec3d p = in_light_view(frustum, point);
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
        const double side = std::max(std::abs(p.x), std::abs(p.y));
        largest_tangent = std::max(largest_tangent,
                                   p.z > 0 ? side / p.z : std::numeric_limits<double>::infinity());
    }
    [[nodiscard]] bool empty() const { return !(lower.x <= upper.x); }
};

LightViewExtent extent_of_scene(const LightFrustum& frustum, const TriangleScene& scene)
{
    LightViewExtent extent;
    for (const Vec3f& vertex : scene.vertices) {
        extent.include(frustum, Vec3d{vertex});
    }
    return extent;
}

void set_symmetric_sides(LightFrustum& frustum, double half)
{
    frustum.left = frustum.bottom = -half;
    frustum.right_side = frustum.top = half;
}

void set_box_sides(LightFrustum& frustum, const LightViewExtent& extent)
{
    frustum.left = extent.lower.x;
    frustum.right_side = extent.upper.x;
    frustum.bottom = extent.lower.y;
    frustum.top = extent.upper.y;
}

void set_sides(LightFrustum& frustum, const FrustumSettings& settings, const LightSettings& light,
               const LightViewExtent& extent)
{
    const bool fixed = settings.fit == Fit::fixed;
    if (frustum.projection == Projection::orthographic) {
        if (fixed) {
            set_symmetric_sides(frustum, settings.half_extent_m);
        } else {
            set_box_sides(frustum, extent);
        }
        return;
    }
    const double fov_deg = fixed && settings.fov_deg ? *settings.fov_deg : light.cone_deg;
    const double tangent = std::tan(0.5 * glm::radians(fov_deg));
    const bool narrow = settings.fit == Fit::camera && extent.largest_tangent > 0;
    set_symmetric_sides(frustum, narrow ? std::min(tangent, extent.largest_tangent) : tangent);
}

} // namespace

LightFrustum fit_light_frustum(const FrustumSettings& settings, const LightSettings& light_settings,
                               const Light& light, const TriangleScene& scene, const Camera& camera,
                               ImageSize image)
{
    const Box box = scene.bounds();
    LightFrustum frustum = place_light_camera(settings, light_settings, light, box);
    const LightViewExtent whole = extent_of_scene(frustum, scene);
    LightViewExtent seen;
    if (settings.fit == Fit::camera) {
        visit_visible_corners(scene, camera, image,
                              [&](const Vec3d& corner) { seen.include(frustum, corner); });
    }
    LightViewExtent sides = seen.empty() ? whole : seen;
    const double smallest_m = smallest_relative_extent * box.diagonal_m();
    LightDistanceRange range{whole.lower.z, sides.upper.z}; // includes casters in front of the view
    widen(sides.lower.x, sides.upper.x, smallest_m);
    widen(sides.lower.y, sides.upper.y, smallest_m);
    widen(range.nearest_m, range.farthest_m, smallest_m);
    if (frustum.projection == Projection::perspective && range.farthest_m <= 0) {
        range.farthest_m = box.diagonal_m(); // everything is behind the spot
    }
    set_sides(frustum, settings, light_settings, sides);
    set_near_far({&frustum, 1}, settings, scene, {range, !seen.empty(), smallest_m});
    make_room_for_distances({&frustum, 1}, settings, scene);
    compose_matrix(frustum);
    return frustum;
}

} // namespace gnomon::scene
