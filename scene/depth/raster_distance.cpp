#include "scene/depth/raster_distance.hpp"

#include "scene/depth/raster_plane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gnomon::scene {
namespace {

constexpr double rounding = 0x1p-24;

/// What GL may be off by where it interpolates these values, each a rounded quotient.
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
