#include "analysis/depth/depth_mapping.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace gnomon::analysis {

DepthMapping::DepthMapping(const scene::DepthRange& range)
    : range_{range},
      depth_per_inverse_m_{1 / range.near_m - 1 / range.far_m}
{
    if (!std::isfinite(near_m()) || !std::isfinite(far_m()) || !(near_m() < far_m())) {
        throw std::domain_error("DepthMapping: near must be below far, both finite");
    }
    if (is_perspective() && !(near_m() > 0)) {
        throw std::domain_error("DepthMapping: near of a perspective must be above 0");
    }
}

double DepthMapping::depth(double zeta_m) const
{
    const double from_end_m = range_.reversed ? far_m() - zeta_m : zeta_m - near_m();
    const double share = from_end_m / (far_m() - near_m());
    if (!is_perspective()) {
        return share;
    }
    return (range_.reversed ? near_m() : far_m()) * share / zeta_m;
}

double DepthMapping::zeta_m(double depth) const
{
    if (!is_perspective()) {
        const double along_m = depth * (far_m() - near_m());
        return range_.reversed ? far_m() - along_m : near_m() + along_m;
    }
    return 1 / (range_.reversed ? 1 / far_m() + depth_per_inverse_m_ * depth
                                : 1 / near_m() - depth_per_inverse_m_ * depth);
}

double DepthMapping::slope_m(double zeta_m) const
{
    return is_perspective() ? depth_per_inverse_m_ * zeta_m * zeta_m : far_m() - near_m();
}

double DepthMapping::zeta_error_m(double zeta_m, double depth_error) const
{
    const double towards_far = range_.reversed ? -depth_error : depth_error;
    if (!is_perspective()) {
        return towards_far * (far_m() - near_m());
    }
    const double relative = depth_per_inverse_m_ * towards_far * zeta_m;
    return relative < 1 ? relative * zeta_m / (1 - relative)
                        : std::numeric_limits<double>::infinity();
}

double DepthMapping::largest_zeta_error_m(double zeta_m, double depth_error) const
{
    const double magnitude = std::abs(depth_error);
    return zeta_error_m(zeta_m, range_.reversed ? -magnitude : magnitude);
}

} // namespace gnomon::analysis
