#include "scene/light/frustum.hpp"

#include "scene/error.hpp"
#include "scene/light/clipped_range.hpp"
#include "scene/view/clip.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

constexpr double auto_padding = 1e-4;       // of the range of ζ, on both sides (DESIGN §7)
constexpr double smallest_spot_near = 1e-3; // of far
/// Closer planes, or a nearer one, leave float32 biases no number for a texel's depth.
constexpr double smallest_given_range_m = 1e-12;
constexpr double smallest_given_near = 1e-24;     // of far
constexpr double smallest_relative_extent = 1e-4; // of the scene's diagonal; flat scenes

/// Extent of points in light view: right, up, forward coordinates and the tangents seen from the
/// origin.
struct LightViewExtent {
    Vec3d lower{std::numeric_limits<double>::infinity()};
    Vec3d upper{-std::numeric_limits<double>::infinity()};
    double largest_tangent = 0;

    void include(const LightFrustum& frustum, const Vec3d& point)
    {
        const Vec3d q = point - frustum.origin;
        const Vec3d p{glm::dot(frustum.right, q), glm::dot(frustum.up, q),
                      glm::dot(frustum.forward, q)};
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
        const double side = std::max(std::abs(p.x), std::abs(p.y));
        largest_tangent = std::max(largest_tangent,
                                   p.z > 0 ? side / p.z : std::numeric_limits<double>::infinity());
    }
    [[nodiscard]] bool empty() const { return !(lower.x <= upper.x); }
};

/// Axes of the light's view: v grows upwards (towards +z for a light that travels vertically), then
/// the roll turns both.
void set_axes(LightFrustum& frustum, const Vec3d& direction, double roll_deg)
{
    frustum.forward = glm::normalize(direction);
    const Vec3d world_up{0, 1, 0};
    const bool vertical = glm::length(glm::cross(frustum.forward, world_up)) < 1e-3;
    const Vec3d hint = vertical ? Vec3d{0, 0, 1} : world_up;
    const Vec3d right = glm::normalize(glm::cross(frustum.forward, hint));
    const Vec3d up = glm::cross(right, frustum.forward);
    const double roll_rad = glm::radians(roll_deg);
    frustum.right = std::cos(roll_rad) * right + std::sin(roll_rad) * up;
    frustum.up = std::cos(roll_rad) * up - std::sin(roll_rad) * right;
}

LightViewExtent extent_of_scene(const LightFrustum& frustum, const TriangleScene& scene)
{
    LightViewExtent extent;
    for (const Vec3f& vertex : scene.vertices) {
        extent.include(frustum, Vec3d{vertex});
    }
    return extent;
}

/// Gives flat scenes a box: no side is smaller than a fraction of the diagonal.
void widen(double& lower, double& upper, double smallest)
{
    if (upper - lower < smallest) {
        const double centre = 0.5 * (lower + upper);
        lower = centre - 0.5 * smallest;
        upper = centre + 0.5 * smallest;
    }
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

/// A range of ζ, and the planes around it.
struct ZetaRange {
    double nearest_m = 0;
    double farthest_m = 0;

    [[nodiscard]] double padding_m() const { return auto_padding * (farthest_m - nearest_m); }
    [[nodiscard]] double near_m() const { return nearest_m - padding_m(); }
    [[nodiscard]] double far_m() const { return farthest_m + padding_m(); }
};

struct DepthPlanes {
    double near_m = 0;
    double far_m = 0;
};

/// The settings' planes; those that they leave to us from `automatic`, a spot's near limited.
DepthPlanes chosen_planes(const FrustumSettings& settings, Projection projection,
                          const DepthPlanes& automatic)
{
    const double far_m = settings.far_m.value_or(automatic.far_m);
    const bool spot = projection == Projection::perspective;
    const double least_m = spot ? smallest_spot_near * far_m : automatic.near_m;
    return {settings.near_m.value_or(std::max(automatic.near_m, least_m)), far_m};
}

/// The whole scene's range of ζ, and how auto planes follow from it.
struct WholeScene {
    ZetaRange range;             ///< up to the farthest that the camera sees, if `keeps_far`
    bool keeps_far = false;      ///< `camera`: nothing beyond what the camera sees matters
    double smallest_range_m = 0; ///< for flat scenes
};

/// The planes around what lies within the map's sides: with the padding, or with as much as the
/// float32 matrix needs for GL to find all of it between them, where that is more.
///
/// Let T be the largest sum of absolute terms of ζ, which no |ζ| exceeds, and u = 2^-24. Z and W
/// err by 5u of their absolute terms: a rounding of each coefficient, four of the products and
/// sums. In ζ that is at most 5u (T + |ζ|) <= 10u T, at a spot's far f, where depth is flattest,
/// f/n times as much: 16u T and 16u T·f/n are to spare. The latter solves f = farthest + 16u T·f/n;
/// half of f, at most, for beyond that the matrix cannot tell the distances anyway. Where near is a
/// thousandth of far, far does not go beyond the whole scene's: near would, too.
DepthPlanes planes_around(const FrustumSettings& settings, Projection projection,
                          const WholeScene& whole, const ZetaRange& inside, double largest_terms_m)
{
    const double rounding_m = 16 * 0x1p-24 * largest_terms_m;
    const double whole_far_m = whole.range.far_m();
    DepthPlanes planes{std::min(inside.near_m(), inside.nearest_m - rounding_m),
                       whole.keeps_far ? whole_far_m : inside.far_m()};
    if (projection == Projection::orthographic) {
        planes.far_m = std::max(planes.far_m, inside.farthest_m + rounding_m);
        return planes;
    }
    const double near_m = chosen_planes(settings, projection, planes).near_m;
    const double lost_share = std::min(0.5, rounding_m / near_m);
    planes.far_m = std::max(planes.far_m, inside.farthest_m / (1 - lost_share));
    if (!settings.near_m && planes.near_m < smallest_spot_near * planes.far_m) {
        planes.far_m = std::min(planes.far_m, whole_far_m);
    }
    return planes;
}

void check_planes(const DepthPlanes& planes, Projection projection)
{
    if (projection == Projection::perspective && !(planes.near_m > 0)) {
        throw InputError(
            fmt::format("shadow_map.near = {}: a spot's near plane must be in front of it, above 0",
                        planes.near_m));
    }
    if (!(planes.near_m < planes.far_m)) {
        throw InputError(fmt::format("shadow_map.near = {} is not below shadow_map.far = {}: "
                                     "correct them, or write \"auto\"",
                                     planes.near_m, planes.far_m));
    }
    if (planes.far_m - planes.near_m < smallest_given_range_m) {
        throw InputError(
            fmt::format("shadow_map.near = {} is too close to shadow_map.far = {}: keep "
                        "them {} m apart, or write \"auto\"",
                        planes.near_m, planes.far_m, smallest_given_range_m));
    }
    if (projection == Projection::perspective &&
        planes.near_m < smallest_given_near * planes.far_m) {
        throw InputError(fmt::format("shadow_map.near = {} is too small for shadow_map.far = {}: "
                                     "write {:.1g} or more, or \"auto\"",
                                     planes.near_m, planes.far_m,
                                     10 * smallest_given_near * planes.far_m));
    }
}

/// The auto planes around what the scene has within the sides, which are set; none where that is
/// nothing, or nothing on the right side of a given plane.
std::optional<DepthPlanes> clipped_planes(LightFrustum& frustum, const FrustumSettings& settings,
                                          const TriangleScene& scene, const WholeScene& whole)
{
    compose_matrix(frustum); // for its rows of x, y and w: they do not depend on near and far
    const ClippedRange inside = clipped_range(frustum, scene);
    ZetaRange range{inside.nearest_m, whole.keeps_far ? whole.range.farthest_m : inside.farthest_m};
    const bool spot = frustum.projection == Projection::perspective;
    if (!(range.nearest_m <= range.farthest_m) || (spot && range.farthest_m <= 0)) {
        return {};
    }
    widen(range.nearest_m, range.farthest_m, whole.smallest_range_m);
    const auto planes =
        planes_around(settings, frustum.projection, whole, range, inside.largest_terms_m);
    const DepthPlanes chosen = chosen_planes(settings, frustum.projection, planes);
    return chosen.near_m < chosen.far_m ? std::optional{chosen} : std::nullopt;
}

/// Near and far from the settings, else around the triangles within the sides, which are set, else
/// around the whole scene.
void set_depth_range(LightFrustum& frustum, const FrustumSettings& settings,
                     const TriangleScene& scene, const WholeScene& whole)
{
    const bool has_both = settings.near_m && settings.far_m;
    const auto clipped = has_both ? std::nullopt : clipped_planes(frustum, settings, scene, whole);
    const DepthPlanes planes = clipped ? *clipped
                                       : chosen_planes(settings, frustum.projection,
                                                       {whole.range.near_m(), whole.range.far_m()});
    check_planes(planes, frustum.projection);
    frustum.near_m = planes.near_m;
    frustum.far_m = planes.far_m;
}

Vec3d camera_position(const LightSettings& settings, const Light& light, const Box& box)
{
    if (light.type == LightType::spot) {
        return light.position;
    }
    return settings.position ? rounded_to_float32(*settings.position) : box.centre();
}

} // namespace

void compose_matrix(LightFrustum& f)
{
    const bool perspective = f.projection == Projection::perspective;
    const auto affine = [&](const Vec3d& axis) { return Vec4d{axis, -glm::dot(axis, f.origin)}; };
    const Vec4d light_distance = affine(f.forward);
    const Vec4d w = perspective ? light_distance : Vec4d{0, 0, 0, 1};
    const auto side = [&](const Vec3d& axis, double low, double high) {
        return (2.0 * affine(axis) - (high + low) * w) / (high - low);
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

LightFrustum fit_light_frustum(const FrustumSettings& settings, const LightSettings& light_settings,
                               const Light& light, const TriangleScene& scene, const Camera& camera,
                               ImageSize image)
{
    const Box box = scene.bounds();
    LightFrustum frustum;
    frustum.projection =
        light.type == LightType::spot ? Projection::perspective : Projection::orthographic;
    frustum.reversed = settings.reversed;
    frustum.clip_range = settings.clip_range.value_or(
        settings.reversed ? ClipRange::zero_to_one : ClipRange::minus_one_to_one);
    frustum.origin = camera_position(light_settings, light, box);
    set_axes(frustum, light.direction, settings.roll_deg);

    const LightViewExtent whole = extent_of_scene(frustum, scene);
    LightViewExtent seen;
    if (settings.fit == Fit::camera) {
        visit_visible_corners(scene, camera, image,
                              [&](const Vec3d& corner) { seen.include(frustum, corner); });
    }
    LightViewExtent sides = seen.empty() ? whole : seen;
    const double smallest_m = smallest_relative_extent * box.diagonal_m();
    ZetaRange range{whole.lower.z, sides.upper.z}; // casters before the view matter too
    widen(sides.lower.x, sides.upper.x, smallest_m);
    widen(sides.lower.y, sides.upper.y, smallest_m);
    widen(range.nearest_m, range.farthest_m, smallest_m);
    if (frustum.projection == Projection::perspective && range.farthest_m <= 0) {
        range.farthest_m = box.diagonal_m(); // everything is behind the spot
    }
    set_sides(frustum, settings, light_settings, sides);
    set_depth_range(frustum, settings, scene, {range, !seen.empty(), smallest_m});
    compose_matrix(frustum);
    return frustum;
}

} // namespace gnomon::scene
