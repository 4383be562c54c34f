#include "analysis/depth/depth_plan.hpp"

#include "analysis/depth/depth_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::Projection;

TEST(DepthPlan, FormulasNearPlaneHasTheTargetsErrorAtFar)
{
    const auto answers = plan_depth({Projection::perspective, 0.01, 200, {}});
    // e = Ahf²/(1 + Ahf) solved for A = e/(hf(f − e)), h = q/2; then 1/n = A + 1/f.
    const double h = 0.5 / 65535;
    const double a = 0.01 / (h * 200 * (200 - 0.01));
    ASSERT_EQ(answers.front().format.name, "d16");
    ASSERT_TRUE(answers.front().formula_near_m);
    EXPECT_NEAR(answers.front().formula_near_m.value_or(0), 1 / (a + 1.0 / 200), 1e-9);
}

TEST(DepthPlan, NearPlanesMeetTheTargetAndNearerOnesMayNot)
{
    for (const auto projection : {Projection::perspective, Projection::orthographic}) {
        for (const double max_error_m : {1e-4, 0.01, 1.0}) {
            for (const PlanAnswer& answer : plan_depth({projection, max_error_m, 200, {}})) {
                if (!answer.near_m) {
                    continue;
                }
                EXPECT_LE(answer.error_at_far_m, max_error_m) << answer.format.name;
                EXPECT_GE(*answer.near_m, answer.formula_near_m.value_or(INFINITY));
                for (int i = 0; i <= 1000; ++i) {
                    const DepthMapping mapping{
                        answer.format.range(projection, *answer.near_m, 200)};
                    const double light_distance_m =
                        *answer.near_m + (200 - *answer.near_m) * i / 1000;
                    // The evaluation's bound may be a little higher between grid points.
                    ASSERT_LE(gl_error_bound_m(mapping, answer.format.coding, light_distance_m),
                              max_error_m * 1.001)
                        << answer.format.name << " at " << light_distance_m;
                }
            }
        }
    }
}

TEST(DepthPlan, ReachOfAGivenNearPlaneEndsWhereTheBoundMeetsTheTarget)
{
    for (const PlanAnswer& answer : plan_depth({Projection::perspective, 0.01, 200, 0.1})) {
        ASSERT_TRUE(answer.reach_m) << answer.format.name;
        const double reach_m = answer.reach_m.value_or(0);
        const DepthMapping mapping{answer.format.range(Projection::perspective, 0.1, 200)};
        if (reach_m < 200) {
            EXPECT_NEAR(gl_error_bound_m(mapping, answer.format.coding, reach_m), 0.01, 1e-6);
            EXPECT_FALSE(answer.near_m);
        } else {
            EXPECT_EQ(answer.near_m, 0.1);
        }
    }
}

TEST(DepthPlan, ReversedFloatTakesAnyNearPlane)
{
    const auto answers = plan_depth({Projection::perspective, 0.01, 200, {}});
    EXPECT_TRUE(answers.back().format.reversed);
    EXPECT_DOUBLE_EQ(answers.back().near_m.value_or(0), 2e-4); // the smallest that is tried
}

TEST(DepthPlan, SaysWhenNoNearPlaneServes)
{
    for (const PlanAnswer& answer : plan_depth({Projection::perspective, 1e-12, 200, {}})) {
        EXPECT_FALSE(answer.near_m) << answer.format.name;
    }
}

TEST(DepthPlan, RejectsTargetsWithoutMeaning)
{
    const auto rejected = [](const PlanTarget& target) {
        EXPECT_THROW((void)plan_depth(target), std::domain_error);
    };
    rejected({Projection::perspective, 0, 200, {}});
    rejected({Projection::perspective, std::nan(""), 200, {}});
    rejected({Projection::perspective, 0.01, -1, {}});
    rejected({Projection::orthographic, 0.01, INFINITY, {}});
    rejected({Projection::perspective, 0.01, 200, 300});
}

} // namespace
} // namespace gnomon::analysis
