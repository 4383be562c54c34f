#include "analysis/comparison/enclosed_light.hpp"

#include "analysis/pixels/receiver_geometry.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

namespace gnomon::analysis {

namespace {

using scene::Object;
using scene::PixelClass;
using scene::Vec3d;

constexpr std::size_t segments_tried = 128;
constexpr std::uint64_t most_lit_of = 100; ///< of so many scored pixels at most one

/// Whether start + t·direction meets the triangle at a t in (0, end).
bool meets(const std::array<scene::Vec3f, 3>& corners, const Vec3d& start, const Vec3d& direction,
           double end)
{
    const Vec3d a{corners[0]};
    const Vec3d p = Vec3d{corners[1]} - a;
    const Vec3d q = Vec3d{corners[2]} - a;
    const Vec3d across = glm::cross(direction, q);
    const double volume = glm::dot(p, across);
    if (volume == 0) {
        return false;
    }
    const Vec3d from_a = start - a;
    const double u = glm::dot(from_a, across) / volume;
    const Vec3d turned = glm::cross(from_a, p);
    const double v = glm::dot(direction, turned) / volume;
    const double t = glm::dot(q, turned) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < end;
}

/// A segment from the light, or a ray.
struct FromLight {
    Vec3d direction;
    double end = 1; ///< [direction]
};

/// The light and one object.
class Shell {
public:
    Shell(const scene::TriangleScene& triangles, const Object& object, const Vec3d& light)
        : triangles_{triangles},
          object_{object},
          light_{light}
    {
    }

    /// Whether it meets at least the share, given as all but one of `of`.
    [[nodiscard]] bool meets_all_but_one(std::span<const FromLight> segments, std::size_t of) const
    {
        std::size_t missed = 0;
        return std::ranges::all_of(segments, [&](const FromLight& segment) {
            missed += is_met(segment) ? 0U : 1U;
            return missed * of <= segments.size();
        });
    }

private:
    [[nodiscard]] bool is_met(const FromLight& segment) const
    {
        for (std::uint32_t i = 0; i < object_.triangle_count; ++i) {
            if (meets(triangles_.corners(object_.first_triangle + i), light_, segment.direction,
                      segment.end)) {
                return true;
            }
        }
        return false;
    }

    const scene::TriangleScene& triangles_;
    const Object& object_;
    Vec3d light_;
};

/// Directions spread evenly over the sphere: steps of the golden angle up a spiral.
std::vector<FromLight> rays_to_all_sides()
{
    constexpr double golden_angle_rad = std::numbers::pi * (3 - 2.23606797749979);
    std::vector<FromLight> rays;
    for (std::size_t i = 0; i < segments_tried; ++i) {
        const double y = 1 - (2 * static_cast<double>(i) + 1) / segments_tried;
        const double radius = std::sqrt(1 - y * y);
        const double angle_rad = golden_angle_rad * static_cast<double>(i);
        rays.push_back({{radius * std::cos(angle_rad), y, radius * std::sin(angle_rad)},
                        std::numeric_limits<double>::infinity()});
    }
    return rays;
}

/// What is seen, as seen from the light.
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

/// Some of the segments to blocked points that other objects show, spread over the image.
std::vector<FromLight> segments_to_others(const scene::TriangleScene& triangles, std::size_t object,
                                          const scene::Image<std::uint32_t>& receivers,
                                          const SeenPixels& seen, const ReceiverGeometry& geometry,
                                          const Vec3d& light)
{
    std::vector<std::size_t> others;
    std::ranges::copy_if(seen.blocked, std::back_inserter(others), [&](std::size_t pixel) {
        return triangles.object_of(receivers[pixel]) != object;
    });
    std::vector<FromLight> segments;
    const std::size_t count = std::min(others.size(), segments_tried);
    for (std::size_t i = 0; i < count; ++i) {
        segments.push_back({geometry.point(others[i * others.size() / count]) - light, 1});
    }
    return segments;
}

bool is_in_box(const scene::TriangleScene& triangles, const Object& object, const Vec3d& point)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    scene::Box box{Vec3d{infinity}, Vec3d{-infinity}};
    for (std::uint32_t i = 0; i < object.triangle_count; ++i) {
        for (const scene::Vec3f& corner : triangles.corners(object.first_triangle + i)) {
            box.lower = glm::min(box.lower, Vec3d{corner});
            box.upper = glm::max(box.upper, Vec3d{corner});
        }
    }
    return glm::min(box.lower, point) == box.lower && glm::max(box.upper, point) == box.upper;
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
    const std::vector<FromLight> rays = rays_to_all_sides();
    for (std::size_t i = 0; i < triangles.objects.size(); ++i) {
        const Object& object = triangles.objects[i];
        if (!object.casts || seen.of_object[i] * 2 > seen.scored ||
            !is_in_box(triangles, object, light)) {
            continue;
        }
        const Shell shell{triangles, object, light};
        if (shell.meets_all_but_one(rays, one_direction_of) &&
            shell.meets_all_but_one(
                segments_to_others(triangles, i, receivers, seen, geometry, light), one_point_of)) {
            names.push_back(object.name);
        }
    }
    return names;
}

} // namespace gnomon::analysis
