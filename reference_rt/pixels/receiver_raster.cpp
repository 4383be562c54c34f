#include "reference_rt/pixels/receiver_raster.hpp"

#include "scene/depth/driver_bound.hpp"

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

/// Whether a corner is in front of the near plane, or outside the narrowest guard band in use (Mesa
/// clips beyond twice the window).
bool may_be_clipped(const Vec4d& clip)
{
    return clip.w <= 0 || clip.z > clip.w || clip.z < 0 || std::abs(clip.x) > 2 * clip.w ||
           std::abs(clip.y) > 2 * clip.w;
}

} // namespace

ReceiverRaster::ReceiverRaster(const scene::TriangleScene& triangles, const scene::View& view,
                               const scene::Box& box, const renderers::RasterFacts& facts)
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
    Vec4d largest{0}; // largest terms of GL's float32 sums
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = triangles_.triangles[triangle][i];
        const Vec4d point{triangles_.vertices[vertex], 1};
        const Vec4d clip = is_captured ? Vec4d{facts_.clip_positions[vertex]} : matrix * point;
        corners[i].clip = clip;
        // Window y points down: X = (x/w + 1)W/2, Y = (1 − y/w)H/2.
        corners[i].position = {half.x * clip.x + (half.x - centre.x) * clip.w,
                               -half.y * clip.y + (half.y - centre.y) * clip.w, clip.w};
        Vec4d sum = glm::abs(clip);
        if (!is_captured) { // absolute products in each row
            sum = Vec4d{0};
            for (int c = 0; c < 4; ++c) {
                sum += glm::abs(matrix[c] * point[c]);
            }
        }
        largest = glm::max(largest, sum);
    }
    // The transform rounds unless its result is known. The clipper interpolates, so it rounds as
    // well.
    if (!is_captured || is_clipped(corners)) {
        for (Corner& corner : corners) {
            corner.error =
                gamma4 * Vec3d{half.x * largest.x + std::abs(half.x - centre.x) * largest.w,
                               half.y * largest.y + std::abs(half.y - centre.y) * largest.w,
                               largest.w};
            corner.depth_error = gamma4 * largest.z;
        }
    }
    return corners;
}

bool ReceiverRaster::is_clipped(const WindowCorners& corners)
{
    return std::ranges::any_of(corners,
                               [](const Corner& corner) { return may_be_clipped(corner.clip); });
}

bool ReceiverRaster::is_near_line(const WindowCorners& corners) const
{
    const double subpixel_px = std::ldexp(1.0, -facts_.subpixel_bits);
    for (std::size_t i = 0; i < 3; ++i) {
        const Corner& p = corners[i];
        const Corner& q = corners[(i + 1) % 3];
        // The edge's line p × q, and its value at the centre, which is the origin.
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
        const auto& [position, error, clip, depth_error] = corners[i];
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

/// The side of a pixel's centre in a clipped triangle: between near plane z = w and far plane z =
/// 0, and clear of the window's border, where GL may clip as well.
ReceiverRaster::Side ReceiverRaster::side_of_clip_planes(const WindowCorners& corners, int x,
                                                         int y) const
{
    const double subpixel_px = std::ldexp(1.0, -facts_.subpixel_bits);
    const Vec3d& p = corners[0].position;
    const Vec3d& q = corners[1].position;
    const Vec3d& r = corners[2].position;
    // The centre, (0, 0, 1), is the sum of line[i].z/volume times corner i.
    const std::array<Vec3d, 3> line{glm::cross(q, r), glm::cross(r, p), glm::cross(p, q)};
    const double volume = glm::dot(p, line[0]);
    // A corner that the clipper makes near the centre has this w, and the corners' combined error.
    const double w = std::abs(volume / (line[0].z + line[1].z + line[2].z));
    const double stray_px = std::max(corners[0].error.x, corners[0].error.y) / w;
    const Vec2d centre = centre_of(x, y);
    const Vec2d border_px = glm::min(centre, Vec2d{image_.width_px, image_.height_px} - centre);
    if (!(std::min(border_px.x, border_px.y) > subpixel_px + stray_px)) {
        return Side::unsure;
    }
    const auto side = [&](double near, double far) { // side of near·w + far·z = 0, positive inside
        Vec3d cut{0};
        double error = 0;
        bool is_cut = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const double height = near * corners[i].clip.w + far * corners[i].clip.z;
            const double height_error = near * corners[i].error.z + corners[i].depth_error;
            cut += height * line[i];
            error += height_error * std::abs(line[i].z);
            is_cut = is_cut || height <= height_error;
        }
        if (is_cut && std::abs(cut.z) <= subpixel_px * std::hypot(cut.x, cut.y) + error) {
            return Side::unsure;
        }
        return !is_cut || cut.z * volume > 0 ? Side::inside : Side::outside;
    };
    return std::max(side(1, -1), side(0, 1)); // outside either plane is outside
}

bool ReceiverRaster::coverage_may_differ(std::uint32_t triangle, int x, int y,
                                         bool is_covered) const
{
    const WindowCorners corners = window_corners(triangle, x, y);
    const bool is_cut = is_clipped(corners);
    const Side planes = is_cut ? side_of_clip_planes(corners, x, y) : Side::inside;
    if (planes == Side::unsure || (is_cut ? is_near_line(corners) : is_near_boundary(corners))) {
        return true;
    }
    // The centre is the origin. With homogeneous corners it is inside if its sides of all edge
    // lines equal the triangle's orientation, for any signs of w.
    const Vec3d& p = corners[0].position;
    const Vec3d& q = corners[1].position;
    const Vec3d& r = corners[2].position;
    const double volume = glm::dot(p, glm::cross(q, r));
    const bool is_turned = volume < 0;
    const auto is_inside = [&](const Vec3d& from, const Vec3d& to) {
        return (from.x * to.y - from.y * to.x < 0) == is_turned;
    };
    // Far from the origin GL's float32 positions can coincide, so the triangle covers nothing.
    const bool is_snapped_over = volume != 0 && planes == Side::inside && is_inside(p, q) &&
                                 is_inside(q, r) && is_inside(r, p);
    return is_snapped_over != is_covered;
}

/// An error bound of a corner's depth.
double ReceiverRaster::vertex_error(std::uint32_t triangle, const WindowCorners& corners) const
{
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& vertex = triangles_.vertices[triangles_.triangles[triangle][i]];
        error = std::max(error, facts_.clip_positions.empty()
                                    ? scene::vertex_depth_error(clip_from_world_, vertex, true)
                                    // For GL's own position only the reciprocal and the product
                                    // round.
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
    if (!is_clipped(corners)) {
        scene::WindowTriangle window{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d& p = corners[i].position;
            window.position_px[i] = Vec2d{p.x / p.z, p.y / p.z} + centre_of(x, y);
            window.depth[i] = corners[i].clip.z / p.z;
        }
        // Drivers may interpolate depth from snapped or unsnapped corners; assume the worse.
        return {g, scene::driver_depth_bound(window, {facts_.subpixel_bits, true},
                                             vertex_error(triangle, corners), centre_of(x, y))};
    }
    // The clipped corners are unknown here, so use the whole window's extent and depth 1.
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
