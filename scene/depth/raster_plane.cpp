#include "scene/depth/raster_plane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

constexpr double half_ulp = 0x1p-24;

double cross(const Vec2d& a, const Vec2d& b)
{
    return a.x * b.y - a.y * b.x;
}

} // namespace

double interpolated(const WindowTriangle& triangle, const Vec2d& at_px)
{
    const auto& [position_px, depth] = triangle;
    const Vec2d d1 = position_px[1] - position_px[0];
    const Vec2d d2 = position_px[2] - position_px[0];
    const Vec2d q = at_px - position_px[0];
    return depth[0] +
           (cross(q, d2) * (depth[1] - depth[0]) + cross(d1, q) * (depth[2] - depth[0])) /
               cross(d1, d2);
}

RasterPlane::RasterPlane(const std::array<Vec4f, 3>& clip, int resolution_texels, ClipRange range)
{
    const bool zero_to_one = range == ClipRange::zero_to_one;
    bool is_inside = true;
    for (std::size_t k = 0; k < clip.size(); ++k) {
        const Vec4d corner{clip.at(k)};
        const Vec3d ndc = Vec3d{corner} / corner.w;
        window_.position_px.at(k) =
            (Vec2d{ndc} * 0.5 + 0.5) * static_cast<double>(resolution_texels);
        window_.depth.at(k) = zero_to_one ? ndc.z : 0.5 * ndc.z + 0.5;
        // Reciprocal and product round; so does the sum of ½z + ½, but not that of 1·z + 0.
        const double division = 2 * half_ulp * std::abs(ndc.z);
        corner_error_ = std::max(corner_error_, zero_to_one ? division : 0.5 * division + half_ulp);
        is_inside = is_inside && corner.z <= corner.w && corner.z >= (zero_to_one ? 0 : -corner.w);
    }
    area2_px2_ = cross(window_.position_px[1] - window_.position_px[0],
                       window_.position_px[2] - window_.position_px[0]);
    is_whole_ = is_inside && area2_px2_ != 0 && std::isfinite(area2_px2_);
}

double RasterPlane::inside_px(const Vec2d& at_px) const
{
    double distance_px = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec2d from = window_.position_px.at(k);
        const Vec2d edge = window_.position_px.at((k + 1) % 3) - from;
        const double side = std::copysign(1.0, area2_px2_) * cross(edge, at_px - from);
        distance_px = std::min(distance_px, side / glm::length(edge));
    }
    return distance_px;
}

double RasterPlane::depth(const Vec2d& at_px) const
{
    return interpolated(window_, at_px);
}

double RasterPlane::driver_bound(const Vec2d& at_px, int subpixel_bits) const
{
    return driver_depth_bound(window_, {subpixel_bits, true}, corner_error_, at_px);
}

namespace {

constexpr double rounding = 0x1p-24;

/// GL's error bound where it interpolates these values, each a rounded quotient.
double interpolation_bound(const WindowTriangle& values, const Vec2d& at_px, int subpixel_bits)
{
    double largest = 0;
    for (const double value : values.depth) {
        largest = std::max(largest, std::abs(value));
    }
    return driver_depth_bound(values, {subpixel_bits, true}, 2 * rounding * largest, at_px);
}

} // namespace

RasterDistance::RasterDistance(const std::array<Vec3f, 3>& corners,
                               const std::array<Vec4f, 3>& clip, const WindowTriangle& window,
                               const LightFrustum& light)
    : position_over_w_{window, window, window},
      inverse_w_{window},
      light_{Vec3f{light.origin}},
      far_m_{static_cast<float>(light.far_m)}
{
    for (std::size_t k = 0; k < 3; ++k) {
        const double w{clip.at(k).w};
        inverse_w_.depth.at(k) = 1 / w;
        for (int axis = 0; axis < 3; ++axis) {
            position_over_w_.at(static_cast<std::size_t>(axis)).depth.at(k) =
                double{corners.at(k)[axis]} / w;
        }
    }
}

Vec3d RasterDistance::position_m(const Vec2d& at_px) const
{
    const Vec3d over_w{interpolated(position_over_w_[0], at_px),
                       interpolated(position_over_w_[1], at_px),
                       interpolated(position_over_w_[2], at_px)};
    return over_w / interpolated(inverse_w_, at_px);
}

double RasterDistance::over_far(const Vec2d& at_px) const
{
    return glm::length(position_m(at_px) - light_) / far_m_;
}

double RasterDistance::driver_bound(const Vec2d& at_px, int subpixel_bits) const
{
    const Vec3d position = position_m(at_px);
    const Vec3d from_light = position - light_;
    const double distance_m = glm::length(from_light);
    const double w = 1 / interpolated(inverse_w_, at_px);
    const double inverse_w_bound = interpolation_bound(inverse_w_, at_px, subpixel_bits);
    double error_m = 16 * rounding * distance_m;
    for (int axis = 0; axis < 3; ++axis) {
        const double magnitude = std::abs(position[axis]);
        const double over_w_bound = interpolation_bound(
            position_over_w_.at(static_cast<std::size_t>(axis)), at_px, subpixel_bits);
        const double position_error = (over_w_bound + magnitude * inverse_w_bound) * w +
                                      4 * rounding * magnitude +
                                      rounding * std::abs(from_light[axis]);
        error_m += std::abs(from_light[axis]) / distance_m * position_error;
    }
    return error_m / far_m_;
}

} // namespace gnomon::scene
