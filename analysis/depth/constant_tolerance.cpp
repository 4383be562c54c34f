#include "analysis/depth/constant_tolerance.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Where a perspective's envelope is as large as the tolerance [m].
/// @param depth_error  Δ, the same at every distance.
double distance_of_error_m(const DepthMapping& mapping, double depth_error, double tolerance_m)
{
    const double a = depth_error * mapping.slope_m(1); // AΔ: the slope is Aζ²
    const double product = a * tolerance_m;
    return 2 * tolerance_m / (product + std::sqrt(product * product + 4 * product));
}

} // namespace

ConstantTolerance constant_tolerance(const DepthMapping& mapping, const DepthCoding& coding,
                                     double tolerance_m)
{
    const std::vector<double> borders = tolerance_borders_m(mapping, coding);
    for (std::size_t i = 1; i < borders.size(); ++i) {
        const double start_m = borders[i - 1];
        const double end_m = borders[i];
        const double between = depth_tolerance(mapping, coding, 0.5 * (start_m + end_m));
        if (mapping.largest_light_distance_error_m(end_m, between) > tolerance_m) {
            return {
                tolerance_m,
                mapping.is_perspective()
                    ? std::clamp(distance_of_error_m(mapping, between, tolerance_m), start_m, end_m)
                    : start_m};
        }
    }
    return {tolerance_m, std::nullopt};
}

} // namespace gnomon::analysis
