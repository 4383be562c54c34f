#include "analysis/depth/depth_error.hpp"

#include "depth_case.hpp"
#include "lane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::ClipRange;
using scene::Projection;
using test::all_mappings;
using test::lesson_range;

/// LargestError of the table for near 4, far 50: error half a code about near, envelope at far,
/// largest.
struct LargestError {
    int bits;
    double near_m;
    double far_m;
    double largest_m;
};
constexpr LargestError table[] = {
    {8, 7.23e-3, 1.1535, 1.10259},       {12, 4.49e-4, 0.07031, 0.070109},
    {16, 2.81e-5, 4.3874e-3, 4.3866e-3}, {20, 1.76e-6, 2.7418e-4, 2.7418e-4},
    {24, 1.10e-7, 1.7136e-5, 1.7136e-5}, {32, 4.28e-10, 6.694e-8, 6.694e-8}};

/// Half a unit of the last of `digits` digits.
double half_digit(double value, int digits)
{
    return 0.5000001 * std::pow(10.0, std::floor(std::log10(value)) + 1 - digits);
}

TEST(LargestDepthError, OfTheLessonIsTheTablesForEveryWidth)
{
    const DepthMapping mapping{lesson_range()};
    for (const LargestError& row : table) {
        const DepthCoding coding = DepthCoding::unorm(row.bits);
        const int digits = row.bits == 8 ? 6 : row.bits == 32 ? 4 : 5;
        EXPECT_NEAR(largest_error_m(mapping, coding), row.largest_m,
                    half_digit(row.largest_m, digits))
            << row.bits << " bits";
        const int far_digits = row.bits == 12 || row.bits == 32 ? 4 : 5;
        EXPECT_NEAR(error_envelope_m(mapping, coding, 50), row.far_m,
                    half_digit(row.far_m, far_digits))
            << row.bits << " bits";
        // The table's 20-bit entry, 1.7548e-6, is rounded up.
        EXPECT_NEAR(error_envelope_m(mapping, coding, 4), row.near_m,
                    1.1 * half_digit(row.near_m, 3))
            << row.bits << " bits";
    }
}

TEST(LargestDepthError, IsAttainedHalfACodeBeforeFar)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const DepthCoding coding = DepthCoding::unorm(12);
        const double far_code = mapping.range().reversed ? 0 : 1;
        const double towards_near = mapping.range().reversed ? 1 : -1;
        // Rounds to this side of the tie.
        const double depth = far_code + towards_near * coding.half_step(1) * (1 - 1e-9);
        const double error_m =
            std::abs(stored_depth(mapping, coding, mapping.light_distance_m(depth)).error_m);
        EXPECT_NEAR(error_m, largest_error_m(mapping, coding), 1e-8 * error_m);
    }
}

TEST(LargestDepthError, IsTheSameReversedAndInEitherClipRange)
{
    for (int bits = 8; bits <= 32; ++bits) {
        for (const auto projection : {Projection::perspective, Projection::orthographic}) {
            const DepthCoding coding = DepthCoding::unorm(bits);
            const double expected_m =
                largest_error_m(DepthMapping{lesson_range(projection)}, coding);
            for (const bool reversed : {false, true}) {
                for (const auto range : {ClipRange::minus_one_to_one, ClipRange::zero_to_one}) {
                    EXPECT_DOUBLE_EQ(
                        largest_error_m(DepthMapping{lesson_range(projection, reversed, range)},
                                        coding),
                        expected_m);
                }
            }
        }
    }
}

TEST(Sawtooth, NeverLeavesTheEnvelope)
{
    const int samples = tests::in_lane(5000, 20000);
    std::vector<DepthMapping> mappings = all_mappings();
    mappings.emplace_back(scene::MapContent::distance, lesson_range(Projection::perspective));
    for (const DepthMapping& mapping : mappings) {
        for (int bits = 5; bits <= 32; ++bits) {
            const DepthCoding coding = bits == 5   ? DepthCoding::packed()
                                       : bits == 6 ? DepthCoding::float16()
                                       : bits == 7 ? DepthCoding::float32()
                                                   : DepthCoding::unorm(bits);
            const double largest_m = largest_error_m(mapping, coding);
            // Depth and distance are computed in double: 4 roundings of a depth up to 1, and of
            // reversed depths, which carry their digits, far less.
            const double rounding = 4 * 0x1p-53;
            for (int i = 0; i <= samples; ++i) {
                const double light_distance_m = 4 + 46.0 * i / samples;
                const double error_m =
                    std::abs(stored_depth(mapping, coding, light_distance_m).error_m);
                const double slack_m = rounding * mapping.slope_m(light_distance_m);
                ASSERT_LE(error_m, error_envelope_m(mapping, coding, light_distance_m) + slack_m)
                    << bits << " bits, light distance " << light_distance_m;
                ASSERT_LE(error_m, largest_m + slack_m)
                    << bits << " bits, light distance " << light_distance_m;
            }
        }
    }
}

TEST(Sawtooth, OfTheLessonSweptDenselyReachesTheTablesLargestError)
{
    constexpr int samples = 4'000'000;
    constexpr double swept_m[] = {1.10259, 0.070104, 4.3836e-3};
    const DepthMapping mapping{lesson_range()};
    const int rows = tests::in_lane(1, 3);
    for (int row = 0; row < rows; ++row) {
        const DepthCoding coding = DepthCoding::unorm(8 + 4 * row);
        double largest_m = 0;
        for (int i = 0; i <= samples; ++i) {
            const double light_distance_m = 4 + 46.0 * i / samples;
            const double error_m =
                std::abs(stored_depth(mapping, coding, light_distance_m).error_m);
            ASSERT_LE(error_m, error_envelope_m(mapping, coding, light_distance_m) * (1 + 1e-9));
            largest_m = std::max(largest_m, error_m);
        }
        // From 12 bits on the sweep undersamples the last teeth: which samples it hits decides the
        // fourth digit.
        EXPECT_NEAR(largest_m, swept_m[row], row == 0 ? 5e-6 : 2e-3 * swept_m[row]);
        EXPECT_LE(largest_m, largest_error_m(mapping, coding) * (1 + 1e-9));
    }
}

TEST(Sawtooth, IsZeroAtTheDistancesOfItsCodes)
{
    for (const DepthMapping& mapping : all_mappings()) {
        const DepthCoding coding = DepthCoding::unorm(16);
        for (const std::uint32_t code : {0U, 1U, 1000U, 40000U, 65534U, 65535U}) {
            const double light_distance_m = exact_distance_m(mapping, coding, code);
            const StoredDepth stored = stored_depth(mapping, coding, light_distance_m);
            EXPECT_EQ(stored.code, code);
            // The distance and the way back: up to 16 roundings of at most 50 m.
            EXPECT_NEAR(stored.error_m, 0, 16 * 0x1p-53 * 50);
        }
    }
}

TEST(Sawtooth, OfAnOrthographicProjectionIsTheSameEverywhere)
{
    const DepthMapping mapping{lesson_range(Projection::orthographic)};
    const DepthCoding coding = DepthCoding::unorm(16);
    const double half_step_m = 0.5 * 46 / 65535;
    for (const double light_distance_m : {4.0, 20.0, 50.0}) {
        EXPECT_DOUBLE_EQ(error_envelope_m(mapping, coding, light_distance_m), half_step_m);
    }
    EXPECT_DOUBLE_EQ(largest_error_m(mapping, coding), half_step_m);
}

TEST(FloatDepth, StaysBelowTheSmoothEnvelope)
{
    for (const auto projection : {Projection::perspective, Projection::orthographic}) {
        for (const bool reversed : {false, true}) {
            const DepthMapping mapping{lesson_range(projection, reversed, ClipRange::zero_to_one)};
            for (int i = 0; i <= 10000; ++i) {
                const double light_distance_m = 4 + 46.0 * i / 10000;
                // The smooth bound is first order: AΔζ is at most 50·0.23·2^-24.
                // The last float32 is 2^-149, where the smooth bound is 0.
                ASSERT_LE(error_envelope_m(mapping, DepthCoding::float32(), light_distance_m),
                          smooth_float_envelope_m(mapping, light_distance_m) * (1 + 1e-6) +
                              0x1p-149 * mapping.slope_m(light_distance_m))
                    << light_distance_m;
            }
        }
    }
}

TEST(FloatDepth, ReversedErrsByAtMostFarTimesTwoToMinus26)
{
    const DepthMapping mapping{lesson_range(Projection::perspective, true, ClipRange::zero_to_one)};
    // u·f/4 = 7.45e-7 at ζ = f/2.
    EXPECT_NEAR(smooth_float_envelope_m(mapping, 25), 7.4506e-7, 5e-12);
    double largest_m = 0;
    for (int i = 0; i <= 1'000'000; ++i) {
        const double light_distance_m = 4 + 46e-6 * i;
        largest_m = std::max(
            largest_m,
            std::abs(stored_depth(mapping, DepthCoding::float32(), light_distance_m).error_m));
    }
    EXPECT_LT(largest_m, 50 * 0x1p-26);
    // A sweep of the formula measured 7.25e-7; its distances decide the digits.
    EXPECT_NEAR(largest_m, 7.25e-7, 0.03e-7);
    EXPECT_LE(largest_m, largest_error_m(mapping, DepthCoding::float32()));
}

TEST(FloatDepth, ReversedThroughMinusOneToOneKeepsAnAbsoluteError)
{
    const DepthMapping mapping{lesson_range(Projection::perspective, true)};
    double largest_m = 0;
    for (int i = 0; i <= 1'000'000; ++i) {
        const double light_distance_m = 4 + 46e-6 * i;
        largest_m = std::max(
            largest_m,
            std::abs(stored_depth(mapping, DepthCoding::float32(), light_distance_m).error_m));
    }
    // 2^-26·Aζ² at f: 8.57e-6; measured by a sweep 8.56e-6.
    EXPECT_NEAR(error_envelope_m(mapping, DepthCoding::float32(), 50), 8.57e-6, 0.005e-6);
    EXPECT_NEAR(largest_m, 8.56e-6, 0.02e-6);
}

TEST(DepthCoding, RoundsToTheNearestCode)
{
    const DepthCoding coding = DepthCoding::unorm(8);
    EXPECT_EQ(coding.nearest_code(0), 0U);
    EXPECT_EQ(coding.nearest_code(1), 255U);
    EXPECT_EQ(coding.nearest_code(0.5), 128U); // 127.5 + ½
    EXPECT_EQ(coding.nearest_code(-0.25), 0U);
    EXPECT_EQ(coding.nearest_code(1.25), 255U);
    EXPECT_EQ(DepthCoding::unorm(32).largest_code(), 4294967295U);
    EXPECT_EQ(DepthCoding::float32().nearest_code(0.5), std::bit_cast<std::uint32_t>(0.5F));
}

TEST(DepthCoding, HalvesTheStepOfAFloatWithEachPowerOfTwo)
{
    const DepthCoding coding = DepthCoding::float32();
    EXPECT_EQ(coding.half_step(1), 0x1p-25);
    EXPECT_EQ(coding.half_step(0.75), 0x1p-25);
    EXPECT_EQ(coding.half_step(0.5), 0x1p-25);
    EXPECT_EQ(coding.half_step(0.4999), 0x1p-26);
    EXPECT_EQ(coding.half_step(0), 0x1p-150);
}

TEST(DepthCoding, RejectsOtherWidths)
{
    for (const int bits : {-1, 0, 7, 33}) {
        EXPECT_THROW((void)DepthCoding::unorm(bits), std::domain_error) << bits;
    }
}

} // namespace
} // namespace gnomon::analysis
