#include "analysis/depth/depth_study.hpp"

#include "analysis/depth/code_density.hpp"
#include "analysis/depth/depth_error.hpp"
#include "analysis/depth/transform_error.hpp"

#include <cmath>

namespace gnomon::analysis {

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
    theory.largest_envelope_m = mapping.largest_zeta_error_m(coarsest_at_m, tolerance);
    theory.largest_step_m = largest_code_step_m(mapping, coding);
    theory.half_of_codes_within_m = exact_distance_m(mapping, coding, coding.largest_code() / 2);
    theory.code_share_within_1m = code_share_within(mapping, coding, 1);
    theory.distance_of_1m_step_m = distance_of_step_m(mapping, coding, 1);
    theory.float_limit_m = float_limit_m(mapping);
    theory.separate_transform_at_far_m = transform_m(TransformOrder::view_then_projection);
    theory.premultiplied_transform_at_far_m = transform_m(TransformOrder::premultiplied);
    return theory;
}

std::vector<DepthErrorRow> formula_rows(const DepthMapping& mapping, const DepthCoding& coding,
                                        std::size_t count)
{
    std::vector<DepthErrorRow> rows(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(count - 1);
        const double zeta_m = mapping.near_m() + share * (mapping.far_m() - mapping.near_m());
        rows[i] = formula_row(mapping, coding, zeta_m);
    }
    return rows;
}

} // namespace gnomon::analysis
