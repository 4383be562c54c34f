#include "scene/depth/driver_bound.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene {

namespace {

constexpr double u32 = 0x1p-24;
constexpr double gamma4 = 4 * u32 / (1 - 4 * u32);

/// The depth plane of a window-space triangle, with the terms from which drivers compute it.
struct DepthPlane {
    Vec2d d01;
    Vec2d d20;
    double z01 = 0;
    double z20 = 0;
    double area2 = 0;
    Vec2d slope{};    ///< |dz/dx|, |dz/dy|
    Vec2d reach_px{}; ///< largest |x|, |y| of a corner

    explicit DepthPlane(const WindowTriangle& t)
        : d01{t.position_px[0] - t.position_px[1]},
          d20{t.position_px[2] - t.position_px[0]},
          z01{t.depth[0] - t.depth[1]},
          z20{t.depth[2] - t.depth[0]},
          area2{std::abs(d01.x * d20.y - d20.x * d01.y)}
    {
        slope = {std::abs(z01 * d20.y - z20 * d01.y) / area2,
                 std::abs(d01.x * z20 - d20.x * z01) / area2};
        for (const Vec2d& corner : t.position_px) {
            reach_px = glm::max(reach_px, glm::abs(corner));
        }
    }
};

/// The slopes are differences that cancel in slivers: four roundings of each product.
double cancellation_error(const DepthPlane& p, const Vec2d& from_first_px)
{
    const double x = 4 * u32 * (std::abs(p.z01 * p.d20.y) + std::abs(p.z20 * p.d01.y)) / p.area2;
    const double y = 4 * u32 * (std::abs(p.d01.x * p.z20) + std::abs(p.d20.x * p.z01)) / p.area2;
    return x * from_first_px.x + y * from_first_px.y;
}

/// Window coordinates are float32, so each edge errs by up to a rounding of both ends. A slope's
/// numerator and area may round differently; the area of a sliver then errs by much.
double edge_error(const DepthPlane& p, const Vec2d& from_farthest_px)
{
    const double edge_px = 2 * u32 * std::max(p.reach_px.x, p.reach_px.y);
    const Vec2d span = glm::abs(p.d01) + glm::abs(p.d20);
    const double area_error = edge_px * (span.x + span.y);
    if (2 * area_error > p.area2) {
        return std::numeric_limits<double>::infinity();
    }
    const double numerator_error = edge_px * (std::abs(p.z01) + std::abs(p.z20));
    const Vec2d slope_error = (Vec2d{numerator_error} + area_error * p.slope) / p.area2;
    return slope_error.x * from_farthest_px.x + slope_error.y * from_farthest_px.y;
}

} // namespace

double driver_depth_bound(const WindowTriangle& triangle, const RasterModel& model,
                          double vertex_error, const Vec2d& centre_px)
{
    const DepthPlane p{triangle};
    if (!(p.area2 > 0)) {
        return std::numeric_limits<double>::infinity();
    }
    Vec2d from_farthest_px{};
    for (const Vec2d& corner : triangle.position_px) {
        from_farthest_px = glm::max(from_farthest_px, glm::abs(centre_px - corner));
    }
    const double plane =
        6 * u32 * (std::abs(triangle.depth[0]) + 2 * glm::dot(p.slope, p.reach_px));
    const double snap = model.interpolates_from_snapped
                            ? std::ldexp(p.slope.x + p.slope.y, -(model.subpixel_bits + 1))
                            : 0.0;
    return vertex_error + snap + plane +
           cancellation_error(p, glm::abs(centre_px - triangle.position_px[0])) +
           edge_error(p, from_farthest_px);
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
