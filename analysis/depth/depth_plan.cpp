#include "analysis/depth/depth_plan.hpp"

#include "analysis/depth/depth_error.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

using scene::Projection;

constexpr double smallest_near_share = 1e-6; // share of far; a perspective's near plane is above 0
constexpr int grid_points = 128;

double evaluation_error_m(const DepthMapping& mapping, double light_distance_m)
{
    // At the origin the view matrix has no sums to round: S = 0.
    return transform_error_m(mapping, TransformOrder::view_then_projection, light_distance_m, 0);
}

/// Distances from near to far, evenly spaced by ratio, or by difference for an orthographic range.
double grid_distance_m(const DepthMapping& mapping, int point)
{
    const double share = static_cast<double>(point) / grid_points;
    const double near_m = mapping.near_m();
    const double far_m = mapping.far_m();
    return point == grid_points       ? far_m
           : mapping.is_perspective() ? near_m * std::pow(far_m / near_m, share)
                                      : near_m + share * (far_m - near_m);
}

double stored_error_bound_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    return coding.is_float() ? largest_error_m(mapping, coding)
                             : error_envelope_m(mapping, coding, mapping.far_m(), 2);
}

/// Bound on the error anywhere between near and far.
double gl_worst_error_m(const DepthMapping& mapping, const DepthCoding& coding)
{
    double evaluation_m = 0;
    for (int point = 0; point <= grid_points; ++point) {
        evaluation_m =
            std::max(evaluation_m, evaluation_error_m(mapping, grid_distance_m(mapping, point)));
    }
    return stored_error_bound_m(mapping, coding) + evaluation_m;
}

/// The smallest value in [low, high] for which the condition holds, by bisection. It holds at
/// `high`, and fails below some point.
template <typename Holds>
double bisected(double low, double high, const Holds& holds)
{
    constexpr int halvings = 100;
    for (int i = 0; i < halvings && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        (holds(middle) ? high : low) = middle;
    }
    return high;
}

/// The smallest near plane for which `worst(mapping)` stays within the target.
template <typename Worst>
std::optional<double> smallest_near_m(const PlanTarget& target, const PlannedFormat& format,
                                      const Worst& worst)
{
    const auto serves = [&](double near_m) {
        const DepthMapping mapping{format.range(target.projection, near_m, target.far_m)};
        return worst(mapping) <= target.max_error_m;
    };
    const bool perspective = target.projection == Projection::perspective;
    const double extent_m = perspective ? target.far_m : std::max(std::abs(target.far_m), 1.0);
    const double highest_m = target.far_m - smallest_near_share * extent_m;
    const double lowest_m =
        perspective ? smallest_near_share * target.far_m : std::min(0.0, highest_m);
    if (!serves(highest_m)) {
        return std::nullopt;
    }
    return serves(lowest_m) ? lowest_m : bisected(lowest_m, highest_m, serves);
}

/// The distance up to which errors stay within the target, from near on; empty if not even there.
std::optional<double> reach_m(const DepthMapping& mapping, const DepthCoding& coding,
                              double max_error_m)
{
    const auto errs = [&](double light_distance_m) {
        return gl_error_bound_m(mapping, coding, light_distance_m) > max_error_m;
    };
    double previous_m = mapping.near_m();
    if (errs(previous_m)) {
        return std::nullopt;
    }
    for (int point = 1; point <= grid_points; ++point) {
        const double light_distance_m = grid_distance_m(mapping, point);
        if (errs(light_distance_m)) {
            return bisected(previous_m, light_distance_m, errs);
        }
        previous_m = light_distance_m;
    }
    return mapping.far_m();
}

PlanAnswer answer(const PlanTarget& target, const PlannedFormat& format)
{
    PlanAnswer result;
    result.format = format;
    const auto gl_worst = [&](const DepthMapping& mapping) {
        return gl_worst_error_m(mapping, format.coding);
    };
    result.formula_near_m = smallest_near_m(target, format, [&](const DepthMapping& mapping) {
        return largest_error_m(mapping, format.coding);
    });
    const auto mapping_from = [&](double near_m) {
        return DepthMapping{format.range(target.projection, near_m, target.far_m)};
    };
    if (!target.near_m) {
        result.near_m = smallest_near_m(target, format, gl_worst);
        result.error_at_far_m = result.near_m ? gl_worst(mapping_from(*result.near_m)) : 0;
        return result;
    }
    const DepthMapping given = mapping_from(*target.near_m);
    result.error_at_far_m = gl_worst(given);
    result.reach_m = reach_m(given, format.coding, target.max_error_m);
    if (result.error_at_far_m <= target.max_error_m) {
        result.near_m = target.near_m;
    }
    return result;
}

} // namespace

scene::DepthRange PlannedFormat::range(Projection projection, double near_m, double far_m) const
{
    return {projection, near_m, far_m, reversed,
            reversed ? scene::ClipRange::zero_to_one : scene::ClipRange::minus_one_to_one};
}

std::vector<PlannedFormat> planned_formats()
{
    return {{"d16", DepthCoding::unorm(16), false},
            {"d24", DepthCoding::unorm(24), false},
            {"d32f", DepthCoding::float32(), false},
            {"d32f", DepthCoding::float32(), true}};
}

double gl_error_bound_m(const DepthMapping& mapping, const DepthCoding& coding,
                        double light_distance_m)
{
    const double codes = coding.is_float() ? 1 : 2;
    return error_envelope_m(mapping, coding, light_distance_m, codes) +
           evaluation_error_m(mapping, light_distance_m);
}

std::vector<PlanAnswer> plan_depth(const PlanTarget& target)
{
    const bool perspective = target.projection == Projection::perspective;
    if (!(target.max_error_m > 0) || !std::isfinite(target.max_error_m)) {
        throw std::domain_error("plan_depth: max_error must be above 0");
    }
    if (!std::isfinite(target.far_m) || (perspective && !(target.far_m > 0))) {
        throw std::domain_error("plan_depth: far must be finite, and above 0 for a perspective");
    }
    std::vector<PlanAnswer> answers;
    for (const PlannedFormat& format : planned_formats()) {
        answers.push_back(answer(target, format));
    }
    return answers;
}

} // namespace gnomon::analysis
