#include "analysis/depth/depth_mapping.hpp"

#include "depth_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Projection;
using test::all_mappings;
using test::seed_range;

TEST(DepthMapping, RunsFromNearToFar)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const double near_depth = mapping.range().reversed ? 1 : 0;
        EXPECT_EQ(mapping.depth(4), near_depth);
        EXPECT_EQ(mapping.depth(50), 1 - near_depth);
        EXPECT_DOUBLE_EQ(mapping.zeta_m(near_depth), 4);
        EXPECT_DOUBLE_EQ(mapping.zeta_m(1 - near_depth), 50);
    }
}

TEST(DepthMapping, OfTheLessonIsItsFormula)
{
    // z_ndc = c2 + c1/ζ with c1 = 2nf/(n − f), c2 = (f + n)/(f − n), the textbook lesson's.
    const DepthMapping mapping{seed_range()};
    const double c1 = 2 * 4.0 * 50 / (4.0 - 50);
    const double c2 = 54.0 / 46;
    for (const double zeta_m : {4.0, 5.0, 10.0, 25.0, 49.0}) {
        // Three roundings of numbers below 2 each, halved.
        EXPECT_NEAR(mapping.depth(zeta_m), 0.5 * (c2 + c1 / zeta_m) + 0.5, 4e-16);
    }
}

TEST(DepthMapping, MatchesTheClipRow)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const scene::Vec2d row = scene::clip_depth_row(mapping.range());
        for (const double zeta_m : {4.0, 7.5, 20.0, 50.0}) {
            const double z_ndc = (row.x * zeta_m + row.y) / (mapping.is_perspective() ? zeta_m : 1);
            const bool halves = mapping.range().clip_range == ClipRange::minus_one_to_one;
            // Coefficients up to 2.4 round thrice.
            EXPECT_NEAR(halves ? 0.5 * z_ndc + 0.5 : z_ndc, mapping.depth(zeta_m), 2e-15);
        }
    }
}

TEST(DepthMapping, ErrorOfADepthIsExact)
{
    for (const DepthMapping& mapping : all_mappings()) {
        for (const double error : {1e-3, -1e-3, 1e-6, -1e-6}) {
            const double zeta_m = 20;
            const double moved_m = mapping.zeta_m(mapping.depth(zeta_m) + error) - zeta_m;
            // The difference of two distances near 20 m, each off by some 1e-16 relative.
            EXPECT_NEAR(mapping.zeta_error_m(zeta_m, error), moved_m, 4e-14);
            EXPECT_GE(mapping.largest_zeta_error_m(zeta_m, error), std::abs(moved_m) - 4e-14);
        }
    }
}

TEST(DepthMapping, HasNoDistanceForDepthsBehindInfinity)
{
    const DepthMapping mapping{seed_range()};
    // 1/ζ = 1/n − Ad is 0 at d = 1/(nA).
    EXPECT_TRUE(std::isinf(mapping.zeta_error_m(50, 0.1)));
}

TEST(DepthMapping, RejectsRangesWithoutExtent)
{
    const auto rejected = [](Projection projection, double near_m, double far_m) {
        EXPECT_THROW((DepthMapping{{projection, near_m, far_m, false, {}}}), std::domain_error)
            << near_m << " to " << far_m;
    };
    for (const auto projection : {Projection::perspective, Projection::orthographic}) {
        rejected(projection, 5, 5);
        rejected(projection, 6, 5);
        rejected(projection, std::nan(""), 5);
        rejected(projection, 1, INFINITY);
    }
    rejected(Projection::perspective, 0, 5);
    rejected(Projection::perspective, -1, 5);
    EXPECT_NO_THROW((DepthMapping{{Projection::orthographic, -1, 5, false, {}}}));
}

} // namespace
} // namespace gnomon::analysis
