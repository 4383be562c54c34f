#include "reference_rt/receiver_raster.hpp"

#include "scene/driver_bound.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon::reference_rt {

using scene::Vec2d;
using scene::Vec3d;
using scene::Vec4d;

namespace {

constexpr double u32 = 0x1p-24;
constexpr double gamma4 = 4 * u32 / (1 - 4 * u32);

Vec2d centre_of(int x, int y)
{
    return {x + 0.5, y + 0.5};
}

/// True when a corner is beyond the near plane, or outside the narrowest guard band in use (Mesa
/// clips beyond twice the window).
bool may_be_clipped(const Vec4d& clip)
{
    return clip.w <= 0 || clip.z > clip.w || clip.z < 0 || std::abs(clip.x) > 2 * clip.w ||
           std::abs(clip.y) > 2 * clip.w;
}

} // namespace

ReceiverRaster::ReceiverRaster(const scene::TriangleScene& triangles, const scene::View& view,
                               const scene::Box& box, const RasterFacts& facts)
    : triangles_{triangles},
      facts_{facts},
      image_{view.image},
      clip_from_world_{camera_clip_from_world(view.camera, view.image, box)}
{
}

ReceiverRaster::WindowCorners ReceiverRaster::window_corners(std::uint32_t triangle, int x,
                                                             int y) const
{
    const scene::Mat4d matrix{clip_from_world_};
    const Vec2d centre = centre_of(x, y);
    const Vec2d half{0.5 * image_.width_px, 0.5 * image_.height_px};
    const bool is_captured = !facts_.clip_positions.empty();
    WindowCorners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = triangles_.triangles[triangle][i];
        const Vec3d point{triangles_.vertices[vertex]};
        const Vec4d clip =
            is_captured ? Vec4d{facts_.clip_positions[vertex]} : matrix * Vec4d{point, 1};
        corners[i].clip = clip;
        // Window y points down: X = (x/w + 1)W/2, Y = (1 − y/w)H/2.
        corners[i].position = {half.x * clip.x + (half.x - centre.x) * clip.w,
                               -half.y * clip.y + (half.y - centre.y) * clip.w, clip.w};
        corners[i].error = Vec3d{0};
        if (!is_captured) {
            Vec4d sum = glm::abs(matrix[3]); // of the absolute products in each row
            for (int c = 0; c < 3; ++c) {
                sum += glm::abs(matrix[c]) * std::abs(point[c]);
            }
            corners[i].error =
                gamma4 * Vec3d{half.x * sum.x + std::abs(half.x - centre.x) * sum.w,
                               half.y * sum.y + std::abs(half.y - centre.y) * sum.w, sum.w};
        }
    }
    return corners;
}

bool ReceiverRaster::is_near_line(const WindowCorners& corners) const
{
    const double subpixel_px = std::ldexp(1.0, -facts_.subpixel_bits);
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner& p = corners[i];
        const Corner& q = corners[(i + 1) % 3];
        // The edge's line p × q, and its value at the centre, which is the origin here.
        const Vec3d line = glm::cross(p.position, q.position);
        const double line_error =
            p.error.x * (std::abs(q.position.y) + q.error.y) + std::abs(p.position.x) * q.error.y +
            p.error.y * (std::abs(q.position.x) + q.error.x) + std::abs(p.position.y) * q.error.x;
        if (std::abs(line.z) <= subpixel_px * std::hypot(line.x, line.y) + line_error) {
            return true;
        }
    }
    return false;
}

bool ReceiverRaster::is_near_boundary(const WindowCorners& corners) const
{
    // Corners that move by up to r move the boundary by up to r.
    double reach_px = std::numbers::sqrt2 * std::ldexp(1.0, -facts_.subpixel_bits);
    std::array<Vec2d, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& [position, error, clip] = corners[i];
        corner[i] = Vec2d{position} / position.z;
        const Vec2d move = (Vec2d{error} + error.z * glm::abs(corner[i])) / position.z;
        // GL divides and scales in float32: four roundings.
        const double rounding_px =
            4 * u32 * (glm::length(corner[i]) + image_.width_px + image_.height_px);
        reach_px = std::max(reach_px, std::numbers::sqrt2 * std::ldexp(1.0, -facts_.subpixel_bits) +
                                          glm::length(move) + rounding_px);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec2d& from = corner[i];
        const Vec2d along = corner[(i + 1) % 3] - from;
        const double length2 = glm::dot(along, along);
        const double r = length2 > 0 ? std::clamp(-glm::dot(from, along) / length2, 0.0, 1.0) : 0.0;
        if (glm::length(from + r * along) <= reach_px) {
            return true;
        }
    }
    return false;
}

bool ReceiverRaster::coverage_may_differ(std::uint32_t triangle, int x, int y,
                                         bool is_covered) const
{
    const WindowCorners corners = window_corners(triangle, x, y);
    const bool is_clipped = std::ranges::any_of(
        corners, [](const Corner& corner) { return may_be_clipped(corner.clip); });
    if (is_clipped ? is_near_line(corners) : is_near_boundary(corners)) {
        return true;
    }
    // The centre is the origin. With homogeneous corners it is inside where its sides of the edges'
    // lines all equal the triangle's orientation, whatever the signs of w.
    const Vec3d& p = corners[0].position;
    const Vec3d& q = corners[1].position;
    const Vec3d& r = corners[2].position;
    const bool is_turned = glm::dot(p, glm::cross(q, r)) < 0;
    const auto is_inside = [&](const Vec3d& from, const Vec3d& to) {
        return (from.x * to.y - from.y * to.x < 0) == is_turned;
    };
    const bool is_snapped_over = is_inside(p, q) && is_inside(q, r) && is_inside(r, p);
    return is_snapped_over != is_covered;
}

/// How far a corner's depth may be from that of `corners`.
double ReceiverRaster::vertex_error(std::uint32_t triangle, const WindowCorners& corners) const
{
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& vertex = triangles_.vertices[triangles_.triangles[triangle][i]];
        error = std::max(error, facts_.clip_positions.empty()
                                    ? scene::vertex_depth_error(clip_from_world_, vertex, true)
                                    // GL's own position: the reciprocal and the product round.
                                    : 2 * u32 * std::abs(corners[i].clip.z / corners[i].clip.w));
    }
    return error;
}

ReceiverRaster::Depth ReceiverRaster::depth(std::uint32_t triangle, int x, int y) const
{
    const WindowCorners corners = window_corners(triangle, x, y);
    // The plane z = gx·X + gy·Y + g through the homogeneous corners, by Cramer's rule; the centre
    // is the origin.
    const Vec3d z{corners[0].clip.z, corners[1].clip.z, corners[2].clip.z};
    const glm::dmat3 rows =
        glm::transpose(glm::dmat3{corners[0].position, corners[1].position, corners[2].position});
    const double volume = glm::dot(rows[0], glm::cross(rows[1], rows[2]));
    const double g = glm::dot(rows[0], glm::cross(rows[1], z)) / volume;
    if (std::ranges::none_of(corners, [](const Corner& c) { return may_be_clipped(c.clip); })) {
        scene::WindowTriangle window{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d& p = corners[i].position;
            window.position_px[i] = Vec2d{p.x / p.z, p.y / p.z} + centre_of(x, y);
            window.depth[i] = corners[i].clip.z / p.z;
        }
        // Whether depth follows the snapped corners is the driver's secret: assume the worse.
        return {g, scene::driver_depth_bound(window, {facts_.subpixel_bits, true},
                                             vertex_error(triangle, corners), centre_of(x, y))};
    }
    // The clipped corners are not known here: the whole window's extent and depth 1 stand for them.
    const double gx = glm::dot(z, glm::cross(rows[1], rows[2])) / volume;
    const double gy = glm::dot(rows[0], glm::cross(z, rows[2])) / volume;
    const double bound =
        6 * u32 * (1 + 2 * (std::abs(gx) * image_.width_px + std::abs(gy) * image_.height_px));
    return {g, std::isfinite(bound) ? bound : 1.0};
}

bool ReceiverRaster::is_tie(std::uint32_t nearer, std::uint32_t farther, int x, int y) const
{
    const Depth front = depth(nearer, x, y);
    const Depth back = depth(farther, x, y);
    return !(front.value - back.value > front.error + back.error);
}

} // namespace gnomon::reference_rt
