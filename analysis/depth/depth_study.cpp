#include "analysis/depth/depth_study.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::analysis {

namespace {

constexpr int detailed_codes = 8;
constexpr int samples_per_code = 16;

/// Adds distances across eight codes about a centre, shifted into [near, far].
void add_codes_about(std::vector<double>& distances_m, const DepthMapping& mapping,
                     const DepthCoding& coding, double centre_m)
{
    const double width_m = detailed_codes * code_step_m(mapping, coding, centre_m);
    const double last_start_m = std::max(mapping.near_m(), mapping.far_m() - width_m);
    const double start_m = std::clamp(centre_m - 0.5 * width_m, mapping.near_m(), last_start_m);
    constexpr int samples = detailed_codes * samples_per_code;
    for (int i = 0; i <= samples; ++i) {
        distances_m.push_back(std::min(start_m + width_m * i / samples, mapping.far_m()));
    }
}

/// Where the tolerance first is too small, or the middle if there is no such place.
double middle_m(const DepthMapping& mapping, const ConstantTolerance& tolerance)
{
    const double near_m = mapping.near_m();
    const double far_m = mapping.far_m();
    const double exceeded_from_m = tolerance.exceeded_from_m.value_or(near_m);
    if (exceeded_from_m > near_m) {
        return exceeded_from_m;
    }
    return near_m > 0 ? std::sqrt(near_m * far_m) : 0.5 * (near_m + far_m);
}

std::vector<double> even_distances_m(const DepthMapping& mapping, std::size_t count)
{
    std::vector<double> distances_m(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        distances_m[i] = mapping.near_m() + share * (mapping.far_m() - mapping.near_m());
    }
    return distances_m;
}

std::vector<DepthErrorRow> rows_at(const std::vector<double>& distances_m,
                                   const DepthMapping& mapping, const DepthCoding& coding)
{
    std::vector<DepthErrorRow> rows(distances_m.size());
    std::transform(
        distances_m.begin(), distances_m.end(), rows.begin(),
        [&](double light_distance_m) { return formula_row(mapping, coding, light_distance_m); });
    return rows;
}

} // namespace

DepthTheory depth_theory(const DepthMapping& mapping, const DepthCoding& coding, double offset_m)
{
    const double near_m = mapping.near_m();
    const double far_m = mapping.far_m();
    // |z of the camera| and |z of the vertex|: the view's z row has no other terms.
    const double row_sum_m = std::abs(offset_m) + std::abs(offset_m - far_m);
    const auto transform_m = [&](TransformOrder order) {
        return transform_error_m(mapping, order, far_m, row_sum_m);
    };
    DepthTheory theory;
    theory.max_error_m = largest_error_m(mapping, coding);
    theory.envelope_at_near_m = error_envelope_m(mapping, coding, near_m);
    theory.envelope_at_far_m = error_envelope_m(mapping, coding, far_m);
    theory.step_at_near_m = code_step_m(mapping, coding, near_m);
    theory.step_at_far_m = code_step_m(mapping, coding, far_m);
    const auto [coarsest_at_m, tolerance] = coarsest_depth(mapping, coding);
    theory.coarsest_at_m = coarsest_at_m;
    theory.largest_envelope_m = mapping.largest_light_distance_error_m(coarsest_at_m, tolerance);
    theory.largest_step_m = largest_code_step_m(mapping, coding);
    theory.half_of_codes_within_m = exact_distance_m(mapping, coding, coding.largest_code() / 2);
    theory.code_share_within_1m = code_share_within(mapping, coding, 1);
    theory.distance_of_1m_step_m = distance_of_step_m(mapping, coding, 1);
    theory.float_limit_m = float_limit_m(mapping);
    if (mapping.stores_gl_depth()) {
        theory.separate_transform_at_far_m = transform_m(TransformOrder::view_then_projection);
        theory.premultiplied_transform_at_far_m = transform_m(TransformOrder::premultiplied);
    }
    return theory;
}

std::vector<DepthErrorRow> formula_rows(const DepthMapping& mapping, const DepthCoding& coding,
                                        std::size_t count)
{
    return rows_at(even_distances_m(mapping, count), mapping, coding);
}

std::vector<DepthErrorRow> tolerance_rows(const DepthMapping& mapping, const DepthCoding& coding,
                                          std::size_t count, const ConstantTolerance& tolerance)
{
    std::vector<double> distances_m = even_distances_m(mapping, count);
    for (const double centre_m :
         {mapping.near_m(), middle_m(mapping, tolerance), mapping.far_m()}) {
        add_codes_about(distances_m, mapping, coding, centre_m);
    }
    std::sort(distances_m.begin(), distances_m.end());
    distances_m.erase(std::unique(distances_m.begin(), distances_m.end()), distances_m.end());
    return rows_at(distances_m, mapping, coding);
}

} // namespace gnomon::analysis
