#include "scene/driver_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene {

namespace {

constexpr double u32 = 0x1p-24;
constexpr double gamma4 = 4 * u32 / (1 - 4 * u32);

} // namespace

double driver_depth_bound(const WindowTriangle& triangle, const RasterModel& model,
                          double vertex_error, const Vec2d& centre_px)
{
    const auto& p = triangle.position_px;
    const auto& z = triangle.depth;
    const Vec2d d01 = p[0] - p[1];
    const Vec2d d20 = p[2] - p[0];
    const double z01 = z[0] - z[1];
    const double z20 = z[2] - z[0];
    const double area2 = std::abs(d01.x * d20.y - d20.x * d01.y);
    if (!(area2 > 0)) {
        return std::numeric_limits<double>::infinity();
    }
    const double slope_x = std::abs(z01 * d20.y - z20 * d01.y) / area2;
    const double slope_y = std::abs(d01.x * z20 - d20.x * z01) / area2;
    const double reach_x = std::max({std::abs(p[0].x), std::abs(p[1].x), std::abs(p[2].x)});
    const double reach_y = std::max({std::abs(p[0].y), std::abs(p[1].y), std::abs(p[2].y)});
    const double plane =
        6 * u32 * (std::abs(z[0]) + 2 * (slope_x * reach_x + slope_y * reach_y));
    // The slopes themselves are differences that cancel in slivers.
    const double sliver_x = 4 * u32 * (std::abs(z01 * d20.y) + std::abs(z20 * d01.y)) / area2;
    const double sliver_y = 4 * u32 * (std::abs(d01.x * z20) + std::abs(d20.x * z01)) / area2;
    const double sliver = sliver_x * std::abs(centre_px.x - p[0].x) +
                          sliver_y * std::abs(centre_px.y - p[0].y);
    const double snap = model.interpolates_from_snapped
                            ? std::ldexp(slope_x + slope_y, -(model.subpixel_bits + 1))
                            : 0.0;
    return vertex_error + snap + plane + sliver;
}

double vertex_depth_error(const Mat4f& clip_from_world, const Vec3f& vertex, bool zero_to_one)
{
    const Mat4d matrix{clip_from_world};
    const Vec4d point{vertex, 1};
    const Vec4d clip = matrix * point;
    if (clip.w == 0) {
        return std::numeric_limits<double>::infinity();
    }
    double sum_z = 0;
    double sum_w = 0;
    for (int column = 0; column < 4; ++column) {
        sum_z += std::abs(matrix[column].z * point[column]);
        sum_w += std::abs(matrix[column].w * point[column]);
    }
    const double ratio = std::abs(clip.z / clip.w);
    const double transform = gamma4 * (sum_z + ratio * sum_w) / std::abs(clip.w);
    if (zero_to_one) {
        return transform + 2 * u32 * ratio; // reciprocal and product; the viewport adds nothing
    }
    return 0.5 * transform + u32 * ratio + u32; // and ½z + ½ rounds
}

} // namespace gnomon::scene
