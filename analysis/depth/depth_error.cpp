#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>
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

/// The window depths between which Δ is constant: those of the coding, and for floats those at
/// which |z_ndc| is a power of two.
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

} // namespace gnomon::analysis
