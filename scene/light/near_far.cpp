#include "scene/light/near_far.hpp"

#include "scene/error.hpp"
#include "scene/light/clipped_range.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace gnomon::scene {
namespace {

constexpr double auto_padding = 1e-4;       // of the range of ζ, on both sides (docs/job_file.md)
constexpr double smallest_spot_near = 1e-3; // of far
/// Closer planes, or a nearer one, leave float32 biases no number for a texel's depth.
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

/// The settings' planes; those that they leave to us from `automatic`, a spot's near limited.
NearFar chosen_planes(const FrustumSettings& settings, Projection projection,
                      const NearFar& automatic)
{
    const double far_m = settings.far_m.value_or(automatic.far_m);
    const bool spot = projection == Projection::perspective;
    const double least_m = spot ? smallest_spot_near * far_m : automatic.near_m;
    return {settings.near_m.value_or(std::max(automatic.near_m, least_m)), far_m};
}

/// The planes around what lies within the map's sides: with the padding, or with as much as the
/// float32 matrix needs for GL to find all of it between them, where that is more.
///
/// Let T be the largest sum of absolute terms of ζ, which no |ζ| exceeds, and u = 2^-24. Z and W
/// err by 5u of their absolute terms: a rounding of each coefficient, four of the products and
/// sums. In ζ that is at most 5u (T + |ζ|) <= 10u T, at a spot's far f, where depth is flattest,
/// f/n times as much: 16u T and 16u T·f/n are to spare. The latter solves f = farthest + 16u T·f/n;
/// half of f, at most, for beyond that the matrix cannot tell the distances anyway. Where near is a
/// thousandth of far, far does not go beyond the whole scene's: near would, too.
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

/// What the scene has within the sides of any of the maps.
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

/// The auto planes around what the scene has within the sides, which are set; none where that is
/// nothing, or nothing on the right side of a given plane.
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
