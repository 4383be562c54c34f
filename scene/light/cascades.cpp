#include "scene/light/cascades.hpp"

#include "scene/camera/clip.hpp"
#include "scene/error.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene/light/near_far.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

constexpr std::array<std::string_view, 3> cascade_split_names{"uniform", "logarithmic",
                                                              "practical"};
constexpr std::array<std::string_view, 2> cascade_fit_names{"tight", "stabilised"};
constexpr std::array<std::string_view, 2> cascade_select_names{"view_depth", "containing"};

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A range of view depths [m].
struct ViewDepths {
    double nearest_m = infinite;
    double farthest_m = -infinite;
};

double view_depth_m(const Camera& camera, const Vec3d& point)
{
    return glm::dot(camera.forward, point - camera.eye);
}

/// The view depths of all visible receivers; without any, as far as the scene is wide.
ViewDepths visible_depths(const TriangleScene& scene, const Camera& camera, ImageSize image)
{
    ViewDepths depths;
    visit_visible_corners(scene, camera, image, [&](const Vec3d& corner) {
        const double depth_m = view_depth_m(camera, corner);
        depths.nearest_m = std::min(depths.nearest_m, depth_m);
        depths.farthest_m = std::max(depths.farthest_m, depth_m);
    });
    const Box box = scene.bounds();
    const double least_m = receiver_near_m(box); // rounding may place a clipped corner before it
    if (!(depths.nearest_m <= depths.farthest_m)) {
        return {least_m, least_m + box.diagonal_m()};
    }
    depths.nearest_m = std::max(depths.nearest_m, least_m);
    depths.farthest_m =
        std::max(depths.farthest_m, depths.nearest_m + smallest_relative_extent * box.diagonal_m());
    return depths;
}

std::string origin_of(const std::optional<double>& given, std::string_view automatic)
{
    return given ? "" : fmt::format(" (that of the {} receiver in view)", automatic);
}

ViewDepths split_range(const CascadeSettings& settings, const TriangleScene& scene,
                       const Camera& camera, ImageSize image)
{
    const bool has_both = settings.near_m && settings.far_m;
    const ViewDepths visible = has_both ? ViewDepths{} : visible_depths(scene, camera, image);
    const ViewDepths range{settings.near_m.value_or(visible.nearest_m),
                           settings.far_m.value_or(visible.farthest_m)};
    if (!(range.nearest_m < range.farthest_m)) {
        throw InputError(fmt::format(
            "shadow_map.cascade_near = {}{} is not below shadow_map.cascade_far = {}{}: give both, "
            "in metres of view depth, or neither",
            range.nearest_m, origin_of(settings.near_m, "nearest"), range.farthest_m,
            origin_of(settings.far_m, "farthest")));
    }
    return range;
}

/// The weight of the logarithmic split against the uniform one.
double logarithmic_share(const CascadeSettings& settings)
{
    switch (settings.split) {
    case CascadeSplit::uniform:
        return 0;
    case CascadeSplit::logarithmic:
        return 1;
    case CascadeSplit::practical:
        return settings.split_lambda;
    }
    return 0;
}

/// A slice of the camera's view.
struct Slice {
    double begin_m = 0;
    double end_m = 0;
};

std::vector<Slice> slices_of(const std::vector<double>& splits, double blend)
{
    std::vector<Slice> slices;
    for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
        const double mixed_m = i == 0 ? 0 : blend * (splits[i] - splits[i - 1]);
        slices.push_back({splits[i] - mixed_m, splits[i + 1]});
    }
    return slices;
}

/// Half the width and half the height of the view at a view depth [m].
Vec2d half_sides_at(const CascadeInputs& inputs, double depth_m)
{
    const Camera& camera = inputs.camera;
    const double aspect =
        static_cast<double>(inputs.image.width_px) / static_cast<double>(inputs.image.height_px);
    const double scale = camera.projection == Projection::perspective ? depth_m : 1;
    return {aspect * camera.half_height * scale, camera.half_height * scale};
}

void set_tight_sides(LightFrustum& map, const CascadeInputs& inputs, const Slice& slice)
{
    const Camera& camera = inputs.camera;
    Vec3d lower{infinite};
    Vec3d upper{-infinite};
    for (const double depth_m : {slice.begin_m, slice.end_m}) {
        const Vec2d half = half_sides_at(inputs, depth_m);
        const Vec3d centre = camera.eye + depth_m * camera.forward;
        for (const double x : {-half.x, half.x}) {
            for (const double y : {-half.y, half.y}) {
                const Vec3d corner = in_light_view(map, centre + x * camera.right + y * camera.up);
                lower = glm::min(lower, corner);
                upper = glm::max(upper, corner);
            }
        }
    }
    map.left = lower.x;
    map.right_side = upper.x;
    map.bottom = lower.y;
    map.top = upper.y;
}

/// A sphere around a slice.
struct SliceSphere {
    double depth_m = 0; ///< of its centre, which is on the camera's axis
    double radius_m = 0;
};

/// The smallest sphere around a slice with its centre on the camera's axis. Corners at view depth z
/// are at k·z from the axis (perspective) or equally far (orthographic). The centre lies at (n +
/// f)(1 + k²)/2, where the corners of both ends are equally far, but not beyond the far end.
SliceSphere sphere_around(const CascadeInputs& inputs, const Slice& slice)
{
    const double begin_side_m = glm::length(half_sides_at(inputs, slice.begin_m));
    const double end_side_m = glm::length(half_sides_at(inputs, slice.end_m));
    const double depth_m = slice.end_m - slice.begin_m;
    const double from_begin_m =
        (depth_m * depth_m + end_side_m * end_side_m - begin_side_m * begin_side_m) / (2 * depth_m);
    const double centre_m = slice.begin_m + std::min(depth_m, from_begin_m);
    const double to_end_m = slice.end_m - centre_m;
    return {centre_m, std::sqrt(to_end_m * to_end_m + end_side_m * end_side_m)};
}

/// The width of a texel, a float32: N texels hold the sphere wherever its centre lies within a
/// texel.
double stable_texel_m(double radius_m, int resolution_texels)
{
    const double least_m = 2 * radius_m / (resolution_texels - 1);
    const auto rounded = static_cast<float>(least_m);
    return double{double{rounded} < least_m
                      ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                      : rounded};
}

/// One side's ends [m from the light's camera], whole texels from the world's origin.
std::array<double, 2> stable_side(const LightFrustum& map, const Vec3d& axis, const Vec3d& centre,
                                  double texel_m, int resolution_texels)
{
    const double texels = std::round(glm::dot(axis, centre) / texel_m);
    const double middle_m = texels * texel_m - glm::dot(axis, map.origin);
    const double half_m = 0.5 * resolution_texels * texel_m;
    return {middle_m - half_m, middle_m + half_m};
}

void set_stable_sides(LightFrustum& map, const CascadeInputs& inputs, const Slice& slice)
{
    const SliceSphere sphere = sphere_around(inputs, slice);
    const Vec3d centre = inputs.camera.eye + sphere.depth_m * inputs.camera.forward;
    const int resolution = inputs.resolution_texels;
    const double texel_m = stable_texel_m(sphere.radius_m, resolution);
    const auto across = stable_side(map, map.right, centre, texel_m, resolution);
    const auto along = stable_side(map, map.up, centre, texel_m, resolution);
    map.left = across[0];
    map.right_side = across[1];
    map.bottom = along[0];
    map.top = along[1];
    map.grid_texels = resolution;
}

/// ζ of all vertices.
LightDistanceRange whole_range(const LightFrustum& camera, const TriangleScene& scene)
{
    LightDistanceRange range{infinite, -infinite};
    for (const Vec3f& vertex : scene.vertices) {
        const double light_distance_m = camera.light_distance_m(Vec3d{vertex});
        range.nearest_m = std::min(range.nearest_m, light_distance_m);
        range.farthest_m = std::max(range.farthest_m, light_distance_m);
    }
    return range;
}

} // namespace

std::string_view cascade_split_name(CascadeSplit split)
{
    return cascade_split_names.at(static_cast<std::size_t>(split));
}

std::string_view cascade_fit_name(CascadeFit fit)
{
    return cascade_fit_names.at(static_cast<std::size_t>(fit));
}

std::string_view cascade_select_name(CascadeSelect select)
{
    return cascade_select_names.at(static_cast<std::size_t>(select));
}

std::vector<double> split_view(const CascadeSettings& settings, const TriangleScene& scene,
                               const Camera& camera, ImageSize image)
{
    const ViewDepths range = split_range(settings, scene, camera, image);
    const double n = range.nearest_m;
    const double f = range.farthest_m;
    const double lambda = logarithmic_share(settings);
    std::vector<double> splits{n};
    for (int i = 1; i < settings.count; ++i) {
        const double share = static_cast<double>(i) / settings.count;
        const double logarithmic = n * std::pow(f / n, share);
        const double uniform = n + (f - n) * share;
        splits.push_back(lambda * logarithmic + (1 - lambda) * uniform);
    }
    splits.push_back(f);
    return splits;
}

std::vector<LightFrustum> fit_cascades(const CascadeInputs& inputs,
                                       const std::vector<double>& splits)
{
    const bool is_stable = inputs.cascades.fit == CascadeFit::stabilised;
    const LightFrustum camera = place_light_camera(inputs.frustum, inputs.light_settings,
                                                   inputs.light, inputs.scene.bounds());
    const double smallest_m = smallest_relative_extent * inputs.scene.bounds().diagonal_m();
    LightDistanceRange range = whole_range(camera, inputs.scene);
    widen(range.nearest_m, range.farthest_m, smallest_m);
    std::vector<LightFrustum> maps;
    for (const Slice& slice : slices_of(splits, inputs.cascades.blend)) {
        LightFrustum& map = maps.emplace_back(camera);
        if (is_stable) {
            set_stable_sides(map, inputs, slice);
            set_near_far_around(map, inputs.frustum, range);
        } else {
            set_tight_sides(map, inputs, slice);
            set_near_far({&map, 1}, inputs.frustum, inputs.scene, {range, false, smallest_m});
        }
        compose_matrix(map);
    }
    return maps;
}

} // namespace gnomon::scene
