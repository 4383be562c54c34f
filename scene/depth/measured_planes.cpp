#include "scene/depth/measured_planes.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace gnomon::scene {

namespace {

constexpr int smallest_tile_texels = 4; // a triangle in it surely covers the centre of a texel
constexpr int largest_map_texels = 16384;
constexpr double half_width_tangent = 0.125; // of the view; 1 − tan 80° · 0.125 is above 0

/// The sampled texel lies at a third of its tile, well inside the half that the triangle covers.
int texel_in_tile(int tile_texels)
{
    return tile_texels / 3;
}

int tiles_across(const MeasuredPlanes& planes)
{
    return planes.resolution_texels / planes.tile_texels;
}

/// Converts a map point, counted from the lower left, to the view's square [−1, 1]².
Vec2d view_position(const MeasuredPlanes& planes, const Vec2d& texels)
{
    return 2.0 / planes.resolution_texels * texels - 1.0;
}

/// Lower left of a sample's tile, counted from the map's lower left [texels].
Vec2d tile_corner(const MeasuredPlanes& planes, std::size_t sample)
{
    const auto across = static_cast<std::size_t>(tiles_across(planes));
    const std::size_t column = sample % across;
    const std::size_t row = sample / across;
    return Vec2d{static_cast<double>(column), static_cast<double>(row)} *
           static_cast<double>(planes.tile_texels);
}

Vec2d sample_position(const MeasuredPlanes& planes, std::size_t sample)
{
    return view_position(planes,
                         tile_corner(planes, sample) + (texel_in_tile(planes.tile_texels) + 0.5));
}

std::array<Vec2d, 3> corner_positions(const MeasuredPlanes& planes, std::size_t sample)
{
    const Vec2d corner = tile_corner(planes, sample);
    const double end = planes.tile_texels - 0.5;
    return {view_position(planes, corner + Vec2d{0.5, 0.5}),
            view_position(planes, corner + Vec2d{end, 0.5}),
            view_position(planes, corner + Vec2d{0.5, end})};
}

void check(const MeasuredPlaneSettings& settings)
{
    if (settings.count < 1 || settings.count > most_measured_planes) {
        throw InputError(
            fmt::format("samples = {}: must be 1 to {}", settings.count, most_measured_planes));
    }
    if (!(settings.tilt_rad >= 0 && settings.tilt_rad <= glm::radians(largest_plane_tilt_deg))) {
        throw InputError(fmt::format("tilt = {:.10g} deg: must be 0 to {}",
                                     glm::degrees(settings.tilt_rad), largest_plane_tilt_deg));
    }
    if (!(std::abs(settings.offset_m) <= max_coordinate_m)) {
        throw InputError(fmt::format("offset = {}: must be within ±{:g} m", settings.offset_m,
                                     max_coordinate_m));
    }
}

void choose_tiles(MeasuredPlanes& planes, const MeasuredPlaneSettings& settings)
{
    const int across = static_cast<int>(std::ceil(std::sqrt(settings.count)));
    planes.tile_texels = std::max(smallest_tile_texels, settings.smallest_map_texels / across);
    planes.resolution_texels = planes.tile_texels * across;
    if (planes.resolution_texels > largest_map_texels) {
        throw InputError(fmt::format("samples = {}: their map is larger than {} texels; ask for "
                                     "fewer",
                                     settings.count, largest_map_texels));
    }
}

void place_camera(LightFrustum& frustum, const MeasuredPlaneSettings& settings)
{
    frustum.projection = settings.range.projection;
    frustum.content = settings.content;
    frustum.near_m = settings.range.near_m;
    frustum.far_m = settings.range.far_m;
    frustum.reversed = settings.range.reversed;
    frustum.clip_range = settings.range.clip_range;
    frustum.origin = rounded_to_float32(Vec3d{settings.offset_m});
    frustum.forward = {0, 0, -1};
    frustum.right = {1, 0, 0};
    frustum.up = {0, 1, 0};
    const bool perspective = frustum.projection == Projection::perspective;
    const double half = half_width_tangent * (perspective ? 1 : frustum.range_m());
    frustum.left = frustum.bottom = -half;
    frustum.right_side = frustum.top = half;
    compose_matrix(frustum);
}

/// A point of a tilted plane through a sample.
class TiltedPlane {
public:
    TiltedPlane(const LightFrustum& frustum, double tilt_rad, const Vec2d& sample)
        : half_{frustum.top},
          is_perspective_{frustum.projection == Projection::perspective},
          slope_{std::tan(tilt_rad)},
          sample_{sample}
    {
    }

    /// Distance at a position of the view, relative to that of the sample: a factor for a
    /// perspective, else metres.
    [[nodiscard]] double relative_light_distance(const Vec2d& at) const
    {
        return is_perspective_ ? (1 - slope_ * half_ * sample_.y) / (1 - slope_ * half_ * at.y)
                               : slope_ * half_ * (at.y - sample_.y);
    }
    [[nodiscard]] double light_distance_m(const Vec2d& at, double sample_light_distance_m) const
    {
        return is_perspective_ ? sample_light_distance_m * relative_light_distance(at)
                               : sample_light_distance_m + relative_light_distance(at);
    }
    [[nodiscard]] Vec3d point(const Vec2d& at, double sample_light_distance_m) const
    {
        const double light_distance = light_distance_m(at, sample_light_distance_m);
        const double side_m = half_ * (is_perspective_ ? light_distance : 1);
        return {at.x * side_m, at.y * side_m, -light_distance};
    }

private:
    double half_;
    bool is_perspective_;
    double slope_;
    Vec2d sample_;
};

/// The range of sample distances for which all corners stay between near and far.
struct SampleRange {
    double first_m = 0;
    double last_m = 0;
};

std::string no_room(const MeasuredPlaneSettings& settings)
{
    const bool stands_straight = settings.tilt_rad == 0 && settings.offset_m == 0;
    return fmt::format("near = {}, far = {}: in float32 no plane fits between them at a tilt of "
                       "{:.10g} deg and an offset of {:.7g} m; widen the range{}",
                       settings.range.near_m, settings.range.far_m, glm::degrees(settings.tilt_rad),
                       settings.offset_m, stands_straight ? "" : ", or lower tilt and offset");
}

SampleRange sample_range(const MeasuredPlanes& planes, const MeasuredPlaneSettings& settings)
{
    const LightFrustum& f = planes.frustum;
    const bool perspective = f.projection == Projection::perspective;
    double least = perspective ? 1 : 0;
    double most = least;
    const auto across = static_cast<std::size_t>(tiles_across(planes));
    const auto count = static_cast<std::size_t>(settings.count);
    for (std::size_t sample = 0; sample < count; sample += across) { // rows differ, columns do not
        const TiltedPlane plane{f, settings.tilt_rad, sample_position(planes, sample)};
        for (const Vec2d& corner : corner_positions(planes, sample)) {
            least = std::min(least, plane.relative_light_distance(corner));
            most = std::max(most, plane.relative_light_distance(corner));
        }
    }
    // Vertices round to float32, and GL computes their depth from terms as large as these.
    const double margin_m = 0x1p-22 * (std::abs(settings.offset_m) + std::abs(f.near_m) + f.far_m);
    const double nearest_m = f.near_m + margin_m;
    // In maps of distances, points in a corner of the map must not lie beyond far.
    const double farthest_m = (f.far_m - margin_m) / f.largest_per_light_distance();
    const SampleRange range = perspective ? SampleRange{nearest_m / least, farthest_m / most}
                                          : SampleRange{nearest_m - least, farthest_m - most};
    if (!(range.first_m < range.last_m)) {
        throw InputError(no_room(settings));
    }
    return range;
}

/// Where a sample lies between first and last: jittered within its share of the range by the golden
/// ratio. Evenly spaced distances would resonate with evenly spaced codes.
double sample_share(std::size_t sample, std::size_t count)
{
    if (sample + 1 == count) {
        return count == 1 ? 0.5 : 1;
    }
    const double turns = static_cast<double>(sample) * std::numbers::phi;
    return (static_cast<double>(sample) + turns - std::floor(turns)) / static_cast<double>(count);
}

void add_triangle(TriangleScene& scene, const std::array<Vec3d, 3>& corners)
{
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const Vec3d& corner : corners) {
        // Adding 0 makes a negative zero positive.
        scene.vertices.push_back(Vec3f{corner} + 0.0F);
    }
    const Vec3d a{scene.vertices[first]};
    const Vec3d b{scene.vertices[first + 1]};
    const Vec3d c{scene.vertices[first + 2]};
    if (glm::cross(b - a, c - a) == Vec3d{0}) {
        throw InputError("offset: at this distance from the origin float32 cannot tell the corners "
                         "of a measured triangle apart; lower it, or ask for fewer samples");
    }
    scene.triangles.push_back({first, first + 1, first + 2});
}

} // namespace

MeasuredPlanes::Texel MeasuredPlanes::texel(std::size_t sample) const
{
    const auto across = static_cast<std::size_t>(tiles_across(*this));
    const int inner = texel_in_tile(tile_texels);
    return {static_cast<int>(sample % across) * tile_texels + inner,
            resolution_texels - 1 - (static_cast<int>(sample / across) * tile_texels + inner)};
}

double MeasuredPlanes::light_distance_m(std::size_t sample) const
{
    const auto corners = triangles.corners(static_cast<std::uint32_t>(sample));
    const Vec3d a = Vec3d{corners[0]} - frustum.origin;
    const Vec3d b = Vec3d{corners[1]} - frustum.origin;
    const Vec3d c = Vec3d{corners[2]} - frustum.origin;
    const Vec3d normal = glm::cross(b - a, c - a);
    const Vec2d side = frustum.top * sample_position(*this, sample);
    if (frustum.projection == Projection::perspective) {
        const Vec3d ray{side, -1};
        const double plane_m = glm::dot(normal, a) / glm::dot(normal, ray);
        const bool is_along_ray = traits_of(frustum.content).measure == Measure::ray;
        return is_along_ray ? plane_m * glm::length(ray) : plane_m;
    }
    return glm::dot(normal, Vec3d{side, 0} - a) / normal.z;
}

MeasuredPlanes make_measured_planes(const MeasuredPlaneSettings& settings)
{
    check(settings);
    MeasuredPlanes planes;
    choose_tiles(planes, settings);
    place_camera(planes.frustum, settings);
    const SampleRange range = sample_range(planes, settings);
    const auto count = static_cast<std::size_t>(settings.count);
    planes.triangles.vertices.reserve(3 * count);
    planes.triangles.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double light_distance_m =
            range.first_m + sample_share(i, count) * (range.last_m - range.first_m);
        const TiltedPlane plane{planes.frustum, settings.tilt_rad, sample_position(planes, i)};
        std::array<Vec3d, 3> corners;
        std::ranges::transform(corner_positions(planes, i), corners.begin(), [&](const Vec2d& at) {
            return planes.frustum.origin + plane.point(at, light_distance_m);
        });
        add_triangle(planes.triangles, corners);
    }
    planes.triangles.objects.push_back({"planes", 0, static_cast<std::uint32_t>(count)});
    return planes;
}

} // namespace gnomon::scene
