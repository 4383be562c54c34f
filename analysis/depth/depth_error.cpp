#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace gnomon::analysis {

namespace {

bool passes_float_ndc(const DepthMapping& mapping, const DepthCoding& coding)
{
    return coding.is_float() && mapping.range().clip_range == scene::ClipRange::minus_one_to_one;
}

std::uint32_t code_of(const DepthMapping& mapping, const DepthCoding& coding, double depth)
{
    if (passes_float_ndc(mapping, coding)) {
        const auto z_ndc = static_cast<float>(2 * depth - 1);
        return std::bit_cast<std::uint32_t>(std::clamp(0.5F * z_ndc + 0.5F, 0.0F, 1.0F));
    }
    return coding.nearest_code(depth);
}

double tolerance_at_depth(const DepthMapping& mapping, const DepthCoding& coding, double depth)
{
    const double half_step = coding.half_step(depth);
    if (!passes_float_ndc(mapping, coding)) {
        return half_step;
    }
    return half_step + 0.5 * std::min(half_float32_step(2 * depth - 1), 0x1p-25);
}

/// The window depths at which d or |z_ndc| is a power of two: between them float32's Δ is constant.
std::vector<double> float_borders()
{
    std::vector<double> depths;
    constexpr int smallest_exponent = -149;
    for (int exponent = 0; exponent >= smallest_exponent; --exponent) {
        const double power = std::ldexp(1.0, exponent);
        depths.insert(depths.end(), {power, 0.5 + 0.5 * power, 0.5 - 0.5 * power});
    }
    return depths;
}

CoarsestDepth coarsest_float_depth(const DepthMapping& mapping, const DepthCoding& coding)
{
    CoarsestDepth coarsest;
    for (const double depth : float_borders()) {
        const CoarsestDepth here{mapping.light_distance_m(depth),
                                 tolerance_at_depth(mapping, coding, depth)};
        if (here.tolerance * mapping.slope_m(here.light_distance_m) >
            coarsest.tolerance * mapping.slope_m(coarsest.light_distance_m)) {
            coarsest = here;
        }
    }
    return coarsest;
}

} // namespace

StoredDepth stored_depth(const DepthMapping& mapping, const DepthCoding& coding,
                         double light_distance_m)
{
    StoredDepth stored;
    stored.code = code_of(mapping, coding, mapping.depth(light_distance_m));
    const SplitDepth depth = coding.split_depth(stored.code);
    stored.depth = depth.depth;
    stored.error_m = mapping.stored_error_m(light_distance_m, depth);
    stored.light_distance_m = mapping.light_distance_m(depth);
    return stored;
}

double depth_tolerance(const DepthMapping& mapping, const DepthCoding& coding,
                       double light_distance_m)
{
    return tolerance_at_depth(mapping, coding, mapping.depth(light_distance_m));
}

CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding)
{
    return coding.is_float() ? coarsest_float_depth(mapping, coding)
                             : CoarsestDepth{mapping.far_m(), coding.half_step(1)};
}

std::vector<double> tolerance_borders_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    std::vector<double> borders{mapping.near_m(), mapping.far_m()};
    if (coding.is_float()) {
        for (const double depth : float_borders()) {
            borders.push_back(
                std::clamp(mapping.light_distance_m(depth), mapping.near_m(), mapping.far_m()));
        }
    }
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
    return borders;
}

double error_envelope_m(const DepthMapping& mapping, const DepthCoding& coding,
                        double light_distance_m, double codes)
{
    return mapping.largest_light_distance_error_m(
        light_distance_m, codes * depth_tolerance(mapping, coding, light_distance_m));
}

double largest_error_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    if (coding.is_float()) {
        const auto [light_distance_m, tolerance] = coarsest_depth(mapping, coding);
        return mapping.largest_light_distance_error_m(light_distance_m, tolerance);
    }
    const double far_m = mapping.far_m();
    const double before_far = coding.half_step(1);
    return -mapping.light_distance_error_m(far_m,
                                           mapping.range().reversed ? before_far : -before_far);
}

double exact_distance_m(const DepthMapping& mapping, const DepthCoding& coding, std::uint32_t code)
{
    return mapping.light_distance_m(coding.split_depth(code));
}

double smooth_float_envelope_m(const DepthMapping& mapping, double light_distance_m)
{
    return 0x1p-24 * mapping.depth(light_distance_m) * mapping.slope_m(light_distance_m);
}

} // namespace gnomon::analysis
