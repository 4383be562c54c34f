#include "analysis/comparison/enclosed_light.hpp"

#include "analysis/pixels/receiver_geometry.hpp"
#include "scene/geometry/surfaces.hpp"
#include "scene/infinity.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace gnomon::analysis {

namespace {

using scene::Object;
using scene::PixelClass;
using scene::Segment;
using scene::Vec3d;

constexpr std::size_t segments_tried = 128;
constexpr std::uint64_t most_lit_of = 100; ///< at most one lit pixel in this many scored pixels

/// Directions spread evenly over the sphere: steps of the golden angle up a spiral.
std::vector<Segment> rays_to_all_sides(const Vec3d& light)
{
    constexpr double golden_angle_rad = std::numbers::pi * (3 - 2.23606797749979);
    std::vector<Segment> rays;
    for (std::size_t i = 0; i < segments_tried; ++i) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / segments_tried;
        const double radius = std::sqrt(1 - y * y);
        const double angle_rad = golden_angle_rad * static_cast<double>(i);
        rays.push_back({light,
                        {radius * std::cos(angle_rad), y, radius * std::sin(angle_rad)},
                        scene::infinity});
    }
    return rays;
}

/// The visible pixels, from the light's point of view.
struct SeenPixels {
    std::vector<std::size_t> blocked;     ///< pixels
    std::vector<std::uint64_t> of_object; ///< scored pixels
    std::uint64_t lit = 0;
    std::uint64_t scored = 0;
};

SeenPixels count_seen(const scene::TriangleScene& triangles,
                      const scene::Image<std::uint32_t>& receivers,
                      const scene::Image<PixelClass>& classes)
{
    SeenPixels seen;
    seen.of_object.resize(triangles.objects.size());
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        ++seen.scored;
        seen.lit += scene::is_lit(classes[i]) ? 1U : 0U;
        ++seen.of_object[triangles.object_of(receivers[i])];
        if (scene::is_blocked(classes[i])) {
            seen.blocked.push_back(i);
        }
    }
    return seen;
}

/// Segments to blocked points on other objects, spread over the image.
std::vector<Segment> segments_to_others(const scene::TriangleScene& triangles, std::size_t object,
                                        const scene::Image<std::uint32_t>& receivers,
                                        const SeenPixels& seen, const ReceiverGeometry& geometry,
                                        const Vec3d& light)
{
    std::vector<std::size_t> others;
    std::ranges::copy_if(seen.blocked, std::back_inserter(others), [&](std::size_t pixel) {
        return triangles.object_of(receivers[pixel]) != object;
    });
    std::vector<Segment> segments;
    const std::size_t count = std::min(others.size(), segments_tried);
    for (std::size_t i = 0; i < count; ++i) {
        segments.push_back({light, geometry.point(others[i * others.size() / count]) - light});
    }
    return segments;
}

bool contains(const scene::Box& box, const Vec3d& point)
{
    return glm::min(box.lower, point) == box.lower && glm::max(box.upper, point) == box.upper;
}

/// Whether the object meets all but at most one in `of` of the segments.
bool meets_all_but_one(const scene::TriangleScene& triangles, const Object& object,
                       std::span<const Segment> segments, std::size_t of)
{
    std::size_t missed = 0;
    return std::ranges::all_of(segments, [&](const Segment& segment) {
        missed += meets(triangles, object, segment) ? 0U : 1U;
        return missed * of <= segments.size();
    });
}

} // namespace

std::vector<std::string> objects_around_light(const scene::TriangleScene& triangles,
                                              const scene::View& view,
                                              const scene::Image<std::uint32_t>& receivers,
                                              const scene::Image<PixelClass>& classes)
{
    constexpr std::size_t one_direction_of = 16;
    constexpr std::size_t one_point_of = 20;
    std::vector<std::string> names;
    if (!view.light.has_position()) {
        return names;
    }
    const SeenPixels seen = count_seen(triangles, receivers, classes);
    if (seen.blocked.empty() || seen.lit * most_lit_of > seen.scored) {
        return names;
    }
    const Vec3d light{view.light.position};
    const ReceiverGeometry geometry{triangles, view, receivers};
    const std::vector<Segment> rays = rays_to_all_sides(light);
    for (std::size_t i = 0; i < triangles.objects.size(); ++i) {
        const Object& object = triangles.objects[i];
        if (!object.casts || seen.of_object[i] * 2 > seen.scored ||
            !contains(bounds_of(triangles, object), light)) {
            continue;
        }
        if (meets_all_but_one(triangles, object, rays, one_direction_of) &&
            meets_all_but_one(triangles, object,
                              segments_to_others(triangles, i, receivers, seen, geometry, light),
                              one_point_of)) {
            names.push_back(object.name);
        }
    }
    return names;
}

} // namespace gnomon::analysis
