#include "reference_rt/receiver_raster.hpp"

#include "scene/driver_bound.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

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

} // namespace

ReceiverRaster::ReceiverRaster(const scene::Camera& camera, scene::ImageSize image,
                               const scene::Box& box, const RasterFacts& facts)
    : clip_from_world_{camera_clip_from_world(camera, image, box)},
      clip_from_world_float_{clip_from_world_},
      image_{image},
      facts_{facts}
{
}

std::array<ReceiverRaster::Corner, 3> ReceiverRaster::window_corners(const Corners& triangle, int x,
                                                                     int y) const
{
    const scene::Mat4d matrix{clip_from_world_float_};
    const Vec2d centre = centre_of(x, y);
    const Vec2d half{0.5 * image_.width_px, 0.5 * image_.height_px};
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec4d clip = matrix * Vec4d{triangle[i], 1};
        Vec4d sum = glm::abs(matrix[3]); // of the absolute products in each row
        for (int c = 0; c < 3; ++c) {
            sum += glm::abs(matrix[c]) * std::abs(triangle[i][c]);
        }
        // Window y points down: X = (x/w + 1)W/2, Y = (1 − y/w)H/2.
        corners[i].position = {half.x * clip.x + (half.x - centre.x) * clip.w,
                               -half.y * clip.y + (half.y - centre.y) * clip.w, clip.w};
        corners[i].error =
            gamma4 * Vec3d{half.x * sum.x + std::abs(half.x - centre.x) * sum.w,
                           half.y * sum.y + std::abs(half.y - centre.y) * sum.w, sum.w};
        corners[i].clip_depth = clip.z;
    }
    return corners;
}

bool ReceiverRaster::is_near_edge(const Corners& triangle, int x, int y) const
{
    const auto corners = window_corners(triangle, x, y);
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

double ReceiverRaster::depth_error(const Corners& triangle, int x, int y) const
{
    const auto corners = window_corners(triangle, x, y);
    if (std::ranges::all_of(corners, [](const Corner& c) { return c.position.z > c.error.z; })) {
        scene::WindowTriangle window{};
        double vertex_error = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3d& p = corners[i].position;
            window.position_px[i] = Vec2d{p.x / p.z, p.y / p.z} + centre_of(x, y);
            window.depth[i] = corners[i].clip_depth / p.z;
            vertex_error =
                std::max(vertex_error, scene::vertex_depth_error(clip_from_world_float_,
                                                                 scene::Vec3f{triangle[i]}, true));
        }
        // Whether depth follows the snapped corners is the driver's secret: assume the worse.
        return scene::driver_depth_bound(window, {facts_.subpixel_bits, true}, vertex_error,
                                         centre_of(x, y));
    }
    // The plane z = gx·X + gy·Y + g through the homogeneous corners, by Cramer's rule.
    const Vec3d z{corners[0].clip_depth, corners[1].clip_depth, corners[2].clip_depth};
    const glm::dmat3 rows =
        glm::transpose(glm::dmat3{corners[0].position, corners[1].position, corners[2].position});
    const double volume = glm::dot(rows[0], glm::cross(rows[1], rows[2]));
    const double gx = glm::dot(z, glm::cross(rows[1], rows[2])) / volume;
    const double gy = glm::dot(rows[0], glm::cross(z, rows[2])) / volume;
    const double bound =
        6 * u32 * (1 + 2 * (std::abs(gx) * image_.width_px + std::abs(gy) * image_.height_px));
    return std::isfinite(bound) ? bound : 1.0;
}

double ReceiverRaster::depth(const Vec3d& point) const
{
    const Vec4d clip = clip_from_world_ * Vec4d{point, 1};
    return clip.z / clip.w;
}

} // namespace gnomon::reference_rt
