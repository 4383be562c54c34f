#include "analysis/depth/depth_error.hpp"

#include "analysis/depth/depth_coding.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {

namespace {

bool passes_float_ndc(const DepthMapping& mapping, const DepthCoding& coding)
{
    return coding.spacing() != scene::Spacing::even &&
           mapping.range().clip_range == scene::ClipRange::minus_one_to_one;
}

std::uint32_t code_of(const DepthMapping& mapping, const DepthCoding& coding, double depth)
{
    if (passes_float_ndc(mapping, coding)) {
        const auto z_ndc = static_cast<float>(2 * depth - 1);
        return coding.nearest_code(double{0.5F * z_ndc + 0.5F});
    }
    return coding.nearest_code(depth);
}

double tolerance_at_depth(const DepthMapping& mapping, const DepthCoding& coding, double depth)
{
    const double half_step = coding.half_step(depth);
    if (!passes_float_ndc(mapping, coding) || !coding.is_float()) {
        return half_step;
    }
    return half_step + 0.5 * std::min(half_float32_step(2 * depth - 1), 0x1p-25);
}

/// The window depths between which Δ is constant: the coding's, and for floats those where |z_ndc|
/// is a power of two.
std::vector<double> border_depths(const DepthCoding& coding)
{
    std::vector<double> depths = coding.borders();
    if (coding.is_float()) {
        for (const double power : coding.borders()) {
            depths.insert(depths.end(), {0.5 + 0.5 * power, 0.5 - 0.5 * power});
        }
    }
    return depths;
}

/// The distance at which a perspective's envelope reaches the tolerance [m].
/// @param depth_error  Δ, constant over distance.
double distance_of_error_m(const DepthMapping& mapping, double depth_error, double tolerance_m)
{
    const double a = depth_error * mapping.slope_m(1); // AΔ: the slope is Aζ²
    const double product = a * tolerance_m;
    return 2 * tolerance_m / (product + std::sqrt(product * product + 4 * product));
}

constexpr double u32 = 0x1p-24;

constexpr double gamma(int roundings)
{
    return roundings * u32 / (1 - roundings * u32);
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
    return coarsest_depth(mapping, coding, mapping.near_m(), mapping.far_m());
}

CoarsestDepth coarsest_depth(const DepthMapping& mapping, const DepthCoding& coding, double from_m,
                             double to_m)
{
    const std::vector<double> borders_m = tolerance_borders_m(mapping, coding);
    CoarsestDepth coarsest{from_m, depth_tolerance(mapping, coding, from_m)};
    for (std::size_t i = 1; i < borders_m.size(); ++i) {
        const double start_m = std::clamp(borders_m[i - 1], from_m, to_m);
        const double end_m = std::clamp(borders_m[i], from_m, to_m);
        if (!(start_m < end_m)) {
            continue;
        }
        const CoarsestDepth here{end_m, depth_tolerance(mapping, coding, 0.5 * (start_m + end_m))};
        if (here.tolerance * mapping.slope_m(here.light_distance_m) >
            coarsest.tolerance * mapping.slope_m(coarsest.light_distance_m)) {
            coarsest = here;
        }
    }
    return coarsest;
}

std::vector<double> tolerance_borders_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    std::vector<double> borders{mapping.near_m(), mapping.far_m()};
    for (const double depth : border_depths(coding)) {
        borders.push_back(
            std::clamp(mapping.light_distance_m(depth), mapping.near_m(), mapping.far_m()));
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
    if (coding.spacing() != scene::Spacing::even) {
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

double transform_error_m(const DepthMapping& mapping, TransformOrder order, double light_distance_m,
                         double row_sum_m)
{
    const scene::Vec2d row = scene::clip_depth_row(mapping.range());
    const double w = mapping.is_perspective() ? light_distance_m : 1;
    const double z_ndc = std::abs(row.x * light_distance_m + row.y) / w;
    const bool premultiplied = order == TransformOrder::premultiplied;
    const double z_error = premultiplied
                               ? gamma(5) * (std::abs(row.x) * row_sum_m + std::abs(row.y))
                               : gamma(3) * (std::abs(row.x) * light_distance_m + std::abs(row.y));
    const bool divides = mapping.is_perspective();
    const double w_error = premultiplied && divides ? gamma(5) * row_sum_m : 0;
    double depth_error = (z_error + z_ndc * w_error) / w + (divides ? u32 * z_ndc : 0);
    if (mapping.range().clip_range == scene::ClipRange::minus_one_to_one) {
        const double viewport =
            std::min(half_float32_step(mapping.depth(light_distance_m)), 0x1p-25);
        depth_error = 0.5 * depth_error + viewport;
    }
    const double view_m = premultiplied ? 0 : gamma(5) * row_sum_m;
    return view_m + mapping.largest_light_distance_error_m(light_distance_m, depth_error);
}

} // namespace gnomon::analysis
