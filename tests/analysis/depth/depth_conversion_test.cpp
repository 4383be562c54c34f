#include "analysis/depth/conversion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

/// What drivers may make of a float32 depth.
namespace gnomon::analysis {
namespace {

const DepthCoding u16 = DepthCoding::unorm(16);
const DepthCoding d32 = DepthCoding::unorm(32);

CodeRange converted(const DepthCoding& coding, double depth)
{
    return converted_codes(coding, depth, depth);
}

/// The ways to convert a float32 depth to 32 bits: exactly, rounded any way; by a product with
/// 2^32 − 1, which is 2^32 in float32; by a signed integer.
std::vector<std::uint32_t> codes_of_drivers(float depth)
{
    const double exact = double{depth} * d32.largest_code();
    const double product = double{depth} * 0x1p32;
    const auto signed_integer = static_cast<std::uint32_t>(depth * 0x1p31F);
    const double largest = d32.largest_code();
    return {static_cast<std::uint32_t>(std::floor(exact)),
            static_cast<std::uint32_t>(std::floor(exact + 0.5)),
            static_cast<std::uint32_t>(std::ceil(exact)),
            static_cast<std::uint32_t>(std::min(std::floor(product), largest)),
            // 1 overflows the doubled integer to 0, and less its highest bit it is 2^32 − 1.
            2 * signed_integer - (signed_integer >> 31U)};
}

TEST(NearestCodes, AreTheTwoThatGlAllows)
{
    EXPECT_EQ(nearest_codes(u16, 0).lower, 0U);
    EXPECT_EQ(nearest_codes(u16, 0).upper, 0U);
    EXPECT_EQ(nearest_codes(u16, 100.25 / 65535).lower, 100U);
    EXPECT_EQ(nearest_codes(u16, 100.25 / 65535).upper, 101U);
    EXPECT_EQ(nearest_codes(u16, 1).lower, 65535U);
    EXPECT_EQ(nearest_codes(u16, 1.5).upper, 65535U);
    const CodeRange floats = nearest_codes(DepthCoding::float32(), 0.75 + 0x1p-26);
    EXPECT_EQ(floats.lower, std::bit_cast<std::uint32_t>(0.75F));
    EXPECT_EQ(floats.upper, floats.lower + 1);
}

TEST(ConvertedCodes, AreTheTwoNearestBelow32Bits)
{
    for (const DepthCoding& coding :
         {DepthCoding::unorm(8), u16, DepthCoding::unorm(24), DepthCoding::float32()}) {
        for (const double depth : {0.0, 1e-9, 0x1p-9, 0.3, 1.0}) {
            EXPECT_EQ(converted(coding, depth).lower, nearest_codes(coding, depth).lower) << depth;
            EXPECT_EQ(converted(coding, depth).upper, nearest_codes(coding, depth).upper) << depth;
            EXPECT_EQ(conversion_drop(coding, depth), 2 * coding.half_step(depth)) << depth;
        }
    }
}

TEST(ConvertedCodes, Of32BitsReachTwoDownWhereAFloatHasFinerDigits)
{
    // 2^31·d = 3.875: 6 by a signed integer; the nearest are 7 and 8.
    const double depth = 3.875 * 0x1p-31;
    EXPECT_EQ(nearest_codes(d32, depth).lower, 7U);
    EXPECT_EQ(converted(d32, depth).lower, 6U);
    EXPECT_EQ(converted(d32, depth).upper, 8U);
    EXPECT_EQ(conversion_drop(d32, depth), 0x1p-31);
    EXPECT_EQ(converted(d32, 0).lower, 0U);
    // From 2^-9 on the last digit of a float32 is 2^-32 or above.
    const float coarse = std::nextafterf(0x1p-9F, 1);
    EXPECT_EQ(converted(d32, coarse).lower, nearest_codes(d32, coarse).lower);
    EXPECT_EQ(conversion_drop(d32, coarse), 2 * d32.half_step(coarse));
}

TEST(ConvertedCodes, ClampToTheRangeOfDepth)
{
    EXPECT_EQ(converted_codes(d32, -0.5, 0x1p-40).lower, 0U);
    EXPECT_EQ(converted_codes(d32, 0.5, 7).upper, d32.largest_code());
    EXPECT_EQ(converted_codes(d32, -INFINITY, INFINITY).upper, d32.largest_code());
    EXPECT_EQ(conversion_rise(DepthCoding::float32(), INFINITY), 0x1p-24);
    EXPECT_EQ(conversion_drop(DepthCoding::float32(), -1), 0x1p-149);
}

TEST(ConvertedCodes, Of32BitsHoldThoseOfEveryWayToConvertAndNoneIsOutOfReach)
{
    std::mt19937 random{32};
    std::uniform_real_distribution<double> exponent{-40, 0};
    bool reaches_lower = false;
    for (int i = 0; i < 200'000; ++i) {
        const auto depth = static_cast<float>(std::exp2(exponent(random)));
        const CodeRange allowed = converted(d32, depth);
        for (const std::uint32_t code : codes_of_drivers(depth)) {
            ASSERT_TRUE(allowed.holds(code)) << std::hexfloat << depth << " as " << code;
            // Quotients of 32 bits by 32 bits, off by a rounding each.
            ASSERT_LE(double{depth} - d32.depth(code), conversion_drop(d32, depth) + 0x1p-53);
            ASSERT_LE(d32.depth(code) - double{depth}, conversion_rise(d32, depth) + 0x1p-53);
            reaches_lower = reaches_lower || (code == allowed.lower && code + 2 == allowed.upper);
        }
    }
    EXPECT_TRUE(reaches_lower); // the second code down is given by a driver, not by caution
}

} // namespace
} // namespace gnomon::analysis
