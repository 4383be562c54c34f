#include "analysis/depth/transform_error.hpp"

#include "analysis/depth/depth_coding.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

constexpr double u32 = 0x1p-24;

constexpr double gamma(int roundings)
{
    return roundings * u32 / (1 - roundings * u32);
}

} // namespace

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
