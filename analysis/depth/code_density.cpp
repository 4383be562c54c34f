#include "analysis/depth/code_density.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {

double code_step_m(const DepthMapping& mapping, const DepthCoding& coding, double light_distance_m)
{
    return 2 * depth_tolerance(mapping, coding, light_distance_m) *
           mapping.slope_m(light_distance_m);
}

double largest_code_step_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    const auto [light_distance_m, tolerance] = coarsest_depth(mapping, coding);
    return 2 * tolerance * mapping.slope_m(light_distance_m);
}

double codes_per_metre(const DepthMapping& mapping, const DepthCoding& coding,
                       double light_distance_m)
{
    return 1 / code_step_m(mapping, coding, light_distance_m);
}

double code_share_within(const DepthMapping& mapping, const DepthCoding& coding,
                         double light_distance_m)
{
    const double depth =
        mapping.depth(std::clamp(light_distance_m, mapping.range().near_m, mapping.far_m()));
    const double share =
        coding.is_float() ? coding.nearest_code(depth) / static_cast<double>(coding.largest_code())
                          : depth;
    return mapping.range().reversed ? 1 - share : share;
}

std::optional<double> distance_of_step_m(const DepthMapping& mapping, const DepthCoding& coding,
                                         double step_m)
{
    if (coding.spacing() != scene::Spacing::even || !mapping.is_perspective()) {
        return std::nullopt;
    }
    return std::sqrt(step_m / code_step_m(mapping, coding, 1));
}

double float_limit_m(const DepthMapping& mapping, int bits)
{
    constexpr int significant_bits = 24;
    if (bits < significant_bits || bits > 32) {
        throw std::domain_error("float_limit_m: bits must be 24 to 32");
    }
    return mapping.light_distance_m(std::ldexp(1.0, significant_bits - 1 - bits));
}

} // namespace gnomon::analysis
