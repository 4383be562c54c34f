#include "analysis/depth/code_density.hpp"

#include "analysis/depth/depth_error.hpp"
#include "depth_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Projection;
using test::lesson_range;

const DepthMapping tenth_to_ten_thousand{{Projection::perspective, 0.1, 10000, false, {}}};
const DepthCoding d24 = DepthCoding::unorm(24);

TEST(CodeDensity, OfD24FromATenthToTenThousandSpendsNineTenthsOnTheFirstMetre)
{
    const double share = code_share_within(tenth_to_ten_thousand, d24, 1);
    EXPECT_GT(share, 0.9);
    EXPECT_NEAR(share, 0.9000, 0.00005); // 90.00 %
    EXPECT_NEAR(code_step_m(tenth_to_ten_thousand, d24, 1000), 0.596, 0.0005);
    const auto metre_m = distance_of_step_m(tenth_to_ten_thousand, d24, 1);
    ASSERT_TRUE(metre_m);
    EXPECT_NEAR(*metre_m, 1295, 0.5);
}

TEST(CodeDensity, IsTheInverseOfTheStep)
{
    EXPECT_DOUBLE_EQ(codes_per_metre(tenth_to_ten_thousand, d24, 1000),
                     1 / code_step_m(tenth_to_ten_thousand, d24, 1000));
}

TEST(CodeDensity, OfAnOrthographicProjectionIsConstant)
{
    const DepthMapping mapping{lesson_range(Projection::orthographic)};
    const DepthCoding coding = DepthCoding::unorm(16);
    for (const double light_distance_m : {4.0, 27.0, 50.0}) {
        EXPECT_DOUBLE_EQ(codes_per_metre(mapping, coding, light_distance_m), 65535 / 46.0);
    }
    EXPECT_DOUBLE_EQ(code_share_within(mapping, coding, 27), 0.5);
    EXPECT_FALSE(distance_of_step_m(mapping, coding, 1));
}

TEST(CodeDensity, CountsCodesWithinADistanceFromNearToFar)
{
    for (const DepthMapping& mapping : test::all_mappings()) {
        for (const DepthCoding& coding : {d24, DepthCoding::float32()}) {
            EXPECT_EQ(code_share_within(mapping, coding, 4), 0);
            EXPECT_EQ(code_share_within(mapping, coding, 50), 1);
            EXPECT_EQ(code_share_within(mapping, coding, 1000), 1);
            const double share = code_share_within(mapping, coding, 20);
            EXPECT_TRUE(share > 0 && share < 1) << share;
        }
    }
}

TEST(LargestCodeStep, OfEvenlySpacedCodesIsFars)
{
    for (const DepthMapping& mapping : test::all_mappings()) {
        EXPECT_DOUBLE_EQ(largest_code_step_m(mapping, d24), code_step_m(mapping, d24, 50));
    }
    EXPECT_DOUBLE_EQ(largest_code_step_m(tenth_to_ten_thousand, d24),
                     code_step_m(tenth_to_ten_thousand, d24, 10000));
}

TEST(LargestCodeStep, OfFloatsIsNowhereExceededAndAttained)
{
    const DepthCoding coding = DepthCoding::float32();
    for (const DepthMapping& mapping : test::all_mappings()) {
        const double largest_m = largest_code_step_m(mapping, coding);
        double swept_m = 0;
        for (int i = 0; i <= 100'000; ++i) {
            swept_m = std::max(swept_m, code_step_m(mapping, coding, 4 + 46e-5 * i));
        }
        EXPECT_LE(swept_m, largest_m * (1 + 1e-15));
        // The sweep misses the largest by up to 4.6e-4 m of some 20, squared.
        EXPECT_GE(swept_m, largest_m * (1 - 1e-4));
    }
    // Reversed 2u·f/4, within the binade of d: ζ = 29.1 m at d = 2^-4.
    const DepthMapping reversed{
        lesson_range(Projection::perspective, true, ClipRange::zero_to_one)};
    EXPECT_NEAR(largest_code_step_m(reversed, coding), 2 * 7.2509e-7, 1e-10);
    EXPECT_NEAR(coarsest_depth(reversed, coding).light_distance_m, 1 / (0.02 + 0.23 / 16), 1e-12);
}

TEST(FloatLimit, IsWhereHalfOfTheDepthsEnd)
{
    const double expected_m = 2 * 4.0 * 50 / 54; // 2fn/(f + n), 7.41
    for (const bool reversed : {false, true}) {
        const DepthMapping mapping{
            lesson_range(Projection::perspective, reversed, ClipRange::zero_to_one)};
        EXPECT_DOUBLE_EQ(float_limit_m(mapping), expected_m);
        const double finer_m = reversed ? expected_m * 1.001 : expected_m / 1.001;
        const double equal_m = reversed ? expected_m / 1.001 : expected_m * 1.001;
        EXPECT_LT(code_step_m(mapping, DepthCoding::float32(), finer_m),
                  0.51 * code_step_m(mapping, d24, finer_m));
        // 2^-24 against 1/(2^24 − 1).
        EXPECT_NEAR(code_step_m(mapping, DepthCoding::float32(), equal_m) /
                        code_step_m(mapping, d24, equal_m),
                    1, 1e-7);
    }
    EXPECT_DOUBLE_EQ(float_limit_m(DepthMapping{lesson_range(Projection::orthographic)}), 27);
}

TEST(FloatLimit, RejectsWidthsThatNeverReachAFloat)
{
    const DepthMapping mapping{lesson_range()};
    EXPECT_THROW((void)float_limit_m(mapping, 23), std::domain_error);
    EXPECT_THROW((void)float_limit_m(mapping, 33), std::domain_error);
}

} // namespace
} // namespace gnomon::analysis
