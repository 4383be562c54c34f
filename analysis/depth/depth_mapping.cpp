#include "analysis/depth/depth_mapping.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {

DepthMapping::DepthMapping(const scene::DepthRange& range)
    : range_{range},
      near_m_{range.near_m},
      depth_per_inverse_m_{(range.far_m - range.near_m) / (range.far_m * range.near_m)}
{
    if (!std::isfinite(near_m()) || !std::isfinite(far_m()) || !(near_m() < far_m())) {
        throw std::domain_error("DepthMapping: near must be below far, both finite");
    }
    if (is_perspective() && !(near_m() > 0)) {
        throw std::domain_error("DepthMapping: near of a perspective must be above 0");
    }
}

DepthMapping::DepthMapping(scene::MapContent content, const scene::DepthRange& drawn)
    : DepthMapping{traits_of(content).stored_range(drawn)}
{
    content_ = content;
    near_m_ = drawn.near_m;
    if (!stores_gl_depth() && !(near_m() >= 0 && near_m() < far_m())) {
        throw std::domain_error("DepthMapping: near of a light must be 0 or more, and below far");
    }
}

SplitDepth DepthMapping::split_depth(double light_distance_m) const
{
    double from_near = (light_distance_m - range_.near_m) / extent_m();
    double from_far = (far_m() - light_distance_m) / extent_m();
    if (is_perspective()) {
        from_near = far_m() * from_near / light_distance_m;
        from_far = near_m() * from_far / light_distance_m;
    }
    return range_.reversed ? SplitDepth{from_far, from_near} : SplitDepth{from_near, from_far};
}

double DepthMapping::light_distance_m(const SplitDepth& depth) const
{
    const auto [from_near, from_far] =
        range_.reversed ? SplitDepth{depth.complement, depth.depth} : depth;
    const bool is_nearer_near = from_near < from_far;
    if (!is_perspective()) {
        return is_nearer_near ? range_.near_m + from_near * extent_m()
                              : far_m() - from_far * extent_m();
    }
    return is_nearer_near ? near_m() / (from_far + near_m() / far_m() * from_near)
                          : far_m() / (from_near + far_m() / near_m() * from_far);
}

double DepthMapping::stored_error_m(double light_distance_m, const SplitDepth& stored) const
{
    const double raised = difference(stored, split_depth(light_distance_m));
    const double towards_far = range_.reversed ? -raised : raised;
    return is_perspective() ? depth_per_inverse_m_ * towards_far * light_distance_m *
                                  this->light_distance_m(stored)
                            : towards_far * extent_m();
}

double DepthMapping::slope_m(double light_distance_m) const
{
    return is_perspective() ? depth_per_inverse_m_ * light_distance_m * light_distance_m
                            : extent_m();
}

double DepthMapping::light_distance_error_m(double light_distance_m, double depth_error) const
{
    const double towards_far = range_.reversed ? -depth_error : depth_error;
    if (!is_perspective()) {
        return towards_far * extent_m();
    }
    const double relative = depth_per_inverse_m_ * towards_far * light_distance_m;
    return relative < 1 ? relative * light_distance_m / (1 - relative)
                        : std::numeric_limits<double>::infinity();
}

double DepthMapping::largest_light_distance_error_m(double light_distance_m,
                                                    double depth_error) const
{
    const double magnitude = std::abs(depth_error);
    return light_distance_error_m(light_distance_m, range_.reversed ? -magnitude : magnitude);
}

double DepthMapping::bias_length_m(double bias, double light_distance_m) const
{
    if (std::isinf(bias)) {
        return bias;
    }
    if (!is_perspective()) {
        return bias * extent_m();
    }
    const double relative = bias_per_inverse_m() * bias * light_distance_m;
    if (relative <= -1.0) {
        return -std::numeric_limits<double>::infinity();
    }
    return relative * light_distance_m / (1.0 + relative);
}

double DepthMapping::bias_of_length(double length_m, double light_distance_m) const
{
    if (!is_perspective()) {
        return length_m / extent_m();
    }
    return length_m < light_distance_m ? length_m / (bias_per_inverse_m() * light_distance_m *
                                                     (light_distance_m - length_m))
                                       : std::numeric_limits<double>::infinity();
}

double DepthMapping::depth_per_metre(double light_distance_m) const
{
    return is_perspective() ? 1.0 / (bias_per_inverse_m() * light_distance_m * light_distance_m)
                            : 1.0 / extent_m();
}

} // namespace gnomon::analysis
