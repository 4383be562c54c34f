#include "analysis/depth/depth_error.hpp"

#include "analysis/depth/depth_study.hpp"
#include "depth_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Projection;
using test::all_mappings;
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

TEST(ConstantTolerance, HoldsUpToWhereTheLessonsEnvelopeIsAsLarge)
{
    // A = 0.23/m, Δ = ½/(2^32 − 1): AΔζ² = 1e-8 m at 19.3255 m, less T/2 = 5e-9 m.
    const DepthMapping mapping{lesson_range()};
    const double expected_m = std::sqrt(1e-8 * 2 * (0x1p32 - 1) / 0.23);
    const auto tolerance = constant_tolerance(mapping, DepthCoding::unorm(32), 1e-8);
    EXPECT_EQ(tolerance.tolerance_m, 1e-8);
    ASSERT_TRUE(tolerance.exceeded_from_m);
    EXPECT_NEAR(*tolerance.exceeded_from_m, expected_m, 1e-8);
    EXPECT_NEAR(expected_m, 19.3255, 1e-4);
}

TEST(ConstantTolerance, IsTooSmallFromNearOnOrNowhere)
{
    for (const DepthMapping& mapping : all_mappings()) {
        for (const auto& coding :
             {DepthCoding::unorm(16), DepthCoding::unorm(32), DepthCoding::float32()}) {
            EXPECT_FALSE(constant_tolerance(mapping, coding, 100).exceeded_from_m);
            EXPECT_EQ(constant_tolerance(mapping, DepthCoding::unorm(16), 1e-12).exceeded_from_m,
                      mapping.near_m());
        }
    }
}

TEST(ConstantTolerance, OfAnOrthographicProjectionIsAllOrNothing)
{
    const DepthMapping mapping{lesson_range(Projection::orthographic)};
    const DepthCoding coding = DepthCoding::unorm(16);
    const double envelope_m = error_envelope_m(mapping, coding, 20);
    EXPECT_FALSE(constant_tolerance(mapping, coding, 1.0001 * envelope_m).exceeded_from_m);
    EXPECT_EQ(constant_tolerance(mapping, coding, 0.9999 * envelope_m).exceeded_from_m, 4);
}

// Up to the distance no envelope exceeds the tolerance; just behind it one does.
TEST(ConstantTolerance, IsTheFirstDistanceThatTheEnvelopeExceeds)
{
    std::mt19937_64 random{20261125};
    std::uniform_real_distribution<double> exponent{-8, 0};
    int found = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const double tolerance_m = std::pow(10, exponent(random));
        for (const DepthMapping& mapping : all_mappings()) {
            for (const auto& coding :
                 {DepthCoding::unorm(16), DepthCoding::unorm(24), DepthCoding::float32()}) {
                const auto from_m =
                    constant_tolerance(mapping, coding, tolerance_m).exceeded_from_m;
                const double end_m = from_m.value_or(mapping.far_m());
                constexpr double rounding =
                    1 + 1e-12; // a few roundings of doubles of both formulas
                for (int i = 0; i < 500 && end_m > mapping.near_m(); ++i) {
                    const double light_distance_m =
                        mapping.near_m() + (end_m - mapping.near_m()) * i / 500;
                    ASSERT_LE(error_envelope_m(mapping, coding, light_distance_m),
                              tolerance_m * rounding)
                        << tolerance_m << " m at " << light_distance_m << " m, float "
                        << coding.is_float() << ", reversed " << mapping.range().reversed;
                }
                if (from_m) {
                    ++found;
                    const double behind_m = std::min(*from_m * (1 + 1e-9), mapping.far_m());
                    EXPECT_GE(error_envelope_m(mapping, coding, behind_m) * rounding, tolerance_m)
                        << tolerance_m << " m, float " << coding.is_float();
                }
            }
        }
    }
    EXPECT_GT(found, 1000);
}

TEST(ToleranceRows, ShowSingleCodesAtBothEndsAndWhereTheToleranceBeginsToBeTooSmall)
{
    const DepthMapping mapping{lesson_range()};
    const DepthCoding coding = DepthCoding::unorm(32);
    const auto tolerance = constant_tolerance(mapping, coding, 1e-8);
    const auto rows = tolerance_rows(mapping, coding, 64, tolerance);
    EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
        return a.light_distance_m <= b.light_distance_m;
    })) << "each distance once";
    EXPECT_EQ(rows.front().light_distance_m, 4);
    EXPECT_EQ(rows.back().light_distance_m, 50);
    for (const double centre_m : {4.0, *tolerance.exceeded_from_m, 50.0}) {
        const double width_m = 8.01 * code_step_m(mapping, coding, centre_m);
        const auto near_it = std::count_if(rows.begin(), rows.end(), [&](const auto& row) {
            return std::abs(row.light_distance_m - centre_m) <= width_m;
        });
        EXPECT_GE(near_it, 129) << centre_m;
    }
    // In detail the teeth reach the envelope: 16 samples a code miss its height by 1/16 at most.
    const auto highest =
        std::max_element(rows.end() - 129, rows.end(), [](const auto& a, const auto& b) {
            return std::abs(a.formula_error_m) < std::abs(b.formula_error_m);
        });
    EXPECT_GT(std::abs(highest->formula_error_m), (1 - 1.0 / 8) * 6.694e-8);
}

} // namespace
} // namespace gnomon::analysis
