#include "scene/light/near_far.hpp"

#include "scene/camera/clip.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::scene {
namespace {

/// A row of the matrix as a linear function of world points, with the sum of its absolute terms.
struct Row {
    Vec3d factors;
    double constant = 0;

    [[nodiscard]] double at(const Vec3d& p) const { return glm::dot(factors, p) + constant; }
    [[nodiscard]] double terms_at(const Vec3d& p) const
    {
        return glm::dot(glm::abs(factors), glm::abs(p)) + std::abs(constant);
    }
};

/// The map's sides: a point is inside where W ± X >= 0 and W ± Y >= 0.
///
/// GL evaluates each row in float32 from four products and three sums, in any order. With u = 2^-24
/// it errs by at most 4u/(1 − 4u) of the sum S of the row's absolute terms; X/W and uv err by 2u
/// more. A test that passes in GL passes exactly after adding 8u (S_W + S_X). Of this, 2u are spare
/// for this file's arithmetic: its double sums and clipped corners err by a few 2^-53 of S. S is
/// convex, so a triangle's corners bound it everywhere in the triangle.
class MapSides {
public:
    explicit MapSides(const Mat4f& light_clip_from_world)
    {
        const Mat4d columns{light_clip_from_world};
        const auto row = [&](int i) {
            return Row{{columns[0][i], columns[1][i], columns[2][i]}, columns[3][i]};
        };
        x_ = row(0);
        y_ = row(1);
        w_ = row(3);
    }

    /// A bit for each side that the point lies outside of by more than the margin there. The margin
    /// is convex: if three corners share a bit, their whole triangle is outside.
    [[nodiscard]] std::uint8_t outside(const Vec3d& p) const
    {
        const double x = x_.at(p);
        const double y = y_.at(p);
        const double w = w_.at(p);
        if (std::abs(x) <= w && std::abs(y) <= w) {
            return 0; // the common case: skips the margins
        }
        const Vec2d margin = margins(p);
        const auto bits = int{w + x < -margin.x} | int{w - x < -margin.x} << 1 |
                          int{w + y < -margin.y} << 2 | int{w - y < -margin.y} << 3;
        return static_cast<std::uint8_t>(bits);
    }

    /// The sides, moved outwards by the largest margin of a triangle's corners.
    [[nodiscard]] std::array<HalfSpace, 4> around(std::span<const Vec3d> triangle) const
    {
        Vec2d margin{0};
        for (const Vec3d& corner : triangle) {
            margin = glm::max(margin, margins(corner));
        }
        const auto side = [&](const Row& row, double sign, double moved) {
            return HalfSpace{w_.factors + sign * row.factors,
                             w_.constant + sign * row.constant + moved};
        };
        return {side(x_, 1, margin.x), side(x_, -1, margin.x), side(y_, 1, margin.y),
                side(y_, -1, margin.y)};
    }

private:
    [[nodiscard]] Vec2d margins(const Vec3d& p) const
    {
        constexpr double eight_roundings = 8 * 0x1p-24;
        const double w = w_.terms_at(p);
        return eight_roundings * Vec2d{w + x_.terms_at(p), w + y_.terms_at(p)};
    }

    Row x_;
    Row y_;
    Row w_;
};

/// Which sides each vertex lies outside of; calls `include` for vertices inside all of them.
template <typename Include>
std::vector<std::uint8_t> vertices_outside(const TriangleScene& scene, const MapSides& sides,
                                           const Include& include)
{
    std::vector<std::uint8_t> outside(scene.vertices.size());
    for (std::size_t i = 0; i < outside.size(); ++i) {
        const Vec3d vertex{scene.vertices[i]};
        outside[i] = sides.outside(vertex);
        if (outside[i] == 0) {
            include(vertex); // every vertex is some triangle's corner
        }
    }
    return outside;
}

/// The light distances ζ of the geometry within a map's sides.
struct ClippedRange {
    double nearest_m = std::numeric_limits<double>::infinity();
    double farthest_m = -std::numeric_limits<double>::infinity();
    /// Largest sum of the absolute terms of ζ there; float32 rounding errors of ζ scale with it.
    double largest_terms_m = 0;
};

/// The range of ζ of all triangles, clipped only to the four sides of the map: near, far and the
/// objects' roles are ignored.
///
/// The sides come from the float32 matrix `light_clip_from_world`, moved outwards by GL's rounding
/// error, so that every point that GL finds inside is included. For a spot they imply ζ >= 0, up to
/// that error.
/// @param frustum  with composed matrices; near and far are ignored.
/// @return  nearest_m > farthest_m if no triangle reaches between the sides.
ClippedRange clipped_range(const LightFrustum& frustum, const TriangleScene& scene)
{
    const Row light_distance{frustum.forward, -glm::dot(frustum.forward, frustum.origin)};
    ClippedRange range;
    const auto include = [&](const Vec3d& point) {
        const double light_distance_m = frustum.light_distance_m(point);
        range.nearest_m = std::min(range.nearest_m, light_distance_m);
        range.farthest_m = std::max(range.farthest_m, light_distance_m);
        range.largest_terms_m = std::max(range.largest_terms_m, light_distance.terms_at(point));
    };
    const MapSides sides{frustum.light_clip_from_world};
    const auto outside = vertices_outside(scene, sides, include);
    if (std::ranges::count(outside, 0) == std::ssize(outside)) {
        return range; // the map encloses the whole scene
    }
    PolygonClipper clipper;
    for (const auto& [i, j, k] : scene.triangles) {
        const bool is_inside = (outside[i] | outside[j] | outside[k]) == 0;
        const bool is_outside = (outside[i] & outside[j] & outside[k]) != 0;
        if (is_inside || is_outside) {
            continue;
        }
        const std::array<Vec3d, 3> triangle{Vec3d{scene.vertices[i]}, Vec3d{scene.vertices[j]},
                                            Vec3d{scene.vertices[k]}};
        std::ranges::for_each(clipper.clip(triangle, sides.around(triangle)), include);
    }
    return range;
}

constexpr double auto_padding = 1e-4;       // of the range of ζ, on both sides (docs/job_file.md)
constexpr double smallest_spot_near = 1e-3; // of far
/// With closer planes or a smaller near, float32 biases could not resolve a texel's depth.
constexpr double smallest_given_range_m = 1e-12;
constexpr double smallest_given_near = 1e-24; // of far

struct NearFar {
    double near_m = 0;
    double far_m = 0;
};

/// The planes around a range, with the padding.
NearFar padded(const LightDistanceRange& range)
{
    const double padding_m = auto_padding * (range.farthest_m - range.nearest_m);
    return {range.nearest_m - padding_m, range.farthest_m + padding_m};
}

/// The settings' planes, with `automatic` for those not given and a limited near for spots.
NearFar chosen_planes(const FrustumSettings& settings, Projection projection,
                      const NearFar& automatic)
{
    const double far_m = settings.far_m.value_or(automatic.far_m);
    const bool spot = projection == Projection::perspective;
    const double least_m = spot ? smallest_spot_near * far_m : automatic.near_m;
    return {settings.near_m.value_or(std::max(automatic.near_m, least_m)), far_m};
}

/// The planes around the geometry within the map's sides, with the padding or, if larger, the
/// margin that the float32 matrix needs so that GL clips none of it.
///
/// Let T be the largest sum of absolute terms of ζ, which bounds |ζ|, and u = 2^-24. Z and W err by
/// 5u of their absolute terms: one rounding of each coefficient, four of products and sums. In ζ
/// that is at most 5u (T + |ζ|) <= 10u T; at a spot's far f, where depth is flattest, f/n times as
/// much. The margins 16u T and 16u T·f/n cover both. The latter solves f = farthest + 16u T·f/n and
/// is limited to half of f, beyond which the matrix cannot resolve distances anyway. If near is a
/// thousandth of far, far stays within the whole scene's, because near would move with it.
NearFar planes_around(const FrustumSettings& settings, Projection projection,
                      const WholeScene& whole, const LightDistanceRange& inside,
                      double largest_terms_m)
{
    const double rounding_m = 16 * 0x1p-24 * largest_terms_m;
    const double whole_far_m = padded(whole.range).far_m;
    NearFar planes = padded(inside);
    planes.near_m = std::min(planes.near_m, inside.nearest_m - rounding_m);
    planes.far_m = whole.keeps_far ? whole_far_m : planes.far_m;
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

void check_planes(const NearFar& planes, Projection projection)
{
    if (projection == Projection::perspective && !(planes.near_m > 0)) {
        throw InputError(
            fmt::format("shadow_map.near = {}: the near plane of a spot or point light must be in "
                        "front of it, above 0",
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

/// The range of the scene within the sides of any of the maps.
ClippedRange range_within(std::span<LightFrustum> maps, const TriangleScene& scene)
{
    ClippedRange all;
    for (LightFrustum& map : maps) {
        compose_matrix(map); // for its rows of x, y and w: they do not depend on near and far
        const ClippedRange inside = clipped_range(map, scene);
        all.nearest_m = std::min(all.nearest_m, inside.nearest_m);
        all.farthest_m = std::max(all.farthest_m, inside.farthest_m);
        all.largest_terms_m = std::max(all.largest_terms_m, inside.largest_terms_m);
    }
    return all;
}

/// The auto planes around the scene within the sides, which must be set. Empty if nothing lies
/// within, or nothing on the right side of a given plane.
std::optional<NearFar> clipped_planes(std::span<LightFrustum> maps, const FrustumSettings& settings,
                                      const TriangleScene& scene, const WholeScene& whole)
{
    const ClippedRange inside = range_within(maps, scene);
    LightDistanceRange range{inside.nearest_m,
                             whole.keeps_far ? whole.range.farthest_m : inside.farthest_m};
    const Projection projection = maps.front().projection;
    const bool is_before_light = projection == Projection::orthographic || range.farthest_m > 0;
    if (!(range.nearest_m <= range.farthest_m) || !is_before_light) {
        return {};
    }
    widen(range.nearest_m, range.farthest_m, whole.smallest_range_m);
    const auto planes = planes_around(settings, projection, whole, range, inside.largest_terms_m);
    const NearFar chosen = chosen_planes(settings, projection, planes);
    return chosen.near_m < chosen.far_m ? std::optional{chosen} : std::nullopt;
}

} // namespace

void set_near_far(std::span<LightFrustum> maps, const FrustumSettings& settings,
                  const TriangleScene& scene, const WholeScene& whole)
{
    const Projection projection = maps.front().projection;
    const bool has_both = settings.near_m && settings.far_m;
    const auto clipped = has_both ? std::nullopt : clipped_planes(maps, settings, scene, whole);
    const NearFar planes =
        clipped ? *clipped : chosen_planes(settings, projection, padded(whole.range));
    check_planes(planes, projection);
    for (LightFrustum& map : maps) {
        map.near_m = planes.near_m;
        map.far_m = planes.far_m;
    }
}

void set_near_far_around(LightFrustum& map, const FrustumSettings& settings,
                         const LightDistanceRange& range)
{
    const NearFar planes = chosen_planes(settings, map.projection, padded(range));
    check_planes(planes, map.projection);
    map.near_m = planes.near_m;
    map.far_m = planes.far_m;
}

void make_room_for_distances(std::span<LightFrustum> maps, const FrustumSettings& settings,
                             const TriangleScene& scene)
{
    const LightFrustum& first = maps.front();
    if (traits_of(first.content).measure != Measure::ray || settings.far_m) {
        return;
    }
    double farthest_m = 0;
    for (const Vec3f& vertex : scene.vertices) {
        farthest_m = std::max(farthest_m, glm::length(Vec3d{vertex} - first.origin));
    }
    const double corner = first.largest_per_light_distance();
    const double far_m = std::clamp((1 + auto_padding) * farthest_m, first.far_m,
                                    (1 + auto_padding) * corner * first.far_m);
    for (LightFrustum& map : maps) {
        map.far_m = double{static_cast<float>((1 + 0x1p-23) * far_m)};
    }
}

void widen(double& lower, double& upper, double smallest)
{
    if (upper - lower < smallest) {
        const double centre = 0.5 * (lower + upper);
        lower = centre - 0.5 * smallest;
        upper = centre + 0.5 * smallest;
    }
}

} // namespace gnomon::scene
