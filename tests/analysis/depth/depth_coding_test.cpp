#include "analysis/depth/depth_coding.hpp"

#include "analysis/depth/measured_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace gnomon::analysis {
namespace {

using scene::DepthFormat;

/// Random float32s in [0, 1] of any size.
class Depths {
public:
    float next()
    {
        return std::bit_cast<float>(
            static_cast<std::uint32_t>(random_() % (std::bit_cast<std::uint32_t>(1.0F) + 1)));
    }
    /// Evenly spread.
    double next_even() { return std::uniform_real_distribution{}(random_); }

private:
    std::mt19937 random_{1};
};

TEST(DepthCoding, OfColourFormatsIsTheirs)
{
    EXPECT_EQ(DepthCoding::of({DepthFormat::Kind::r32f, 32}), DepthCoding::float32());
    EXPECT_EQ(DepthCoding::of({DepthFormat::Kind::d32f, 32}), DepthCoding::float32());
    EXPECT_EQ(DepthCoding::of({DepthFormat::Kind::r16f, 16}), DepthCoding::float16());
    EXPECT_EQ(DepthCoding::of({DepthFormat::Kind::rgba8, 32}), DepthCoding::packed());
    EXPECT_EQ(DepthCoding::float16().bits(), 16);
    EXPECT_EQ(DepthCoding::float16().largest_code(), 0x3C00U);
    EXPECT_EQ(DepthCoding::packed().largest_code(), 0xFFFFFFFFU);
}

TEST(DepthCoding, IsExactAtTheEnds)
{
    for (const DepthCoding& coding : {DepthCoding::unorm(8), DepthCoding::float32(),
                                      DepthCoding::float16(), DepthCoding::packed()}) {
        EXPECT_EQ(coding.depth(coding.nearest_code(0)), 0);
        EXPECT_EQ(coding.depth(coding.nearest_code(1)), 1);
        EXPECT_EQ(coding.nearest_code(1.5), coding.largest_code());
        EXPECT_EQ(coding.split_depth(coding.largest_code()).complement, 0);
    }
}

TEST(DepthCoding, StaysWithinItsHalfStep)
{
    Depths depths;
    for (const DepthCoding& coding : {DepthCoding::unorm(16), DepthCoding::float32(),
                                      DepthCoding::float16(), DepthCoding::packed()}) {
        for (int i = 0; i < 200'000; ++i) {
            const double depth = i % 2 == 0 ? depths.next_even() : double{depths.next()};
            // Two roundings of the evenly spaced code's quotient.
            ASSERT_LE(std::abs(coding.depth(coding.nearest_code(depth)) - depth),
                      coding.half_step(depth) + 0x1p-52)
                << depth << ", " << coding.bits() << " bits";
        }
    }
}

TEST(DepthCoding, NearlyReachesThePackedHalfStep)
{
    const DepthCoding packed = DepthCoding::packed();
    for (const int k : {1, 64, 128, 129, 200, 255}) {
        double largest = 0;
        for (int i = 0; i < 4096; ++i) {
            const double depth = (k + i / 4096.0) / 256;
            largest = std::max(largest, std::abs(packed.depth(packed.nearest_code(depth)) - depth));
        }
        // The next first byte's 1/65280, for a float32 that rounds to it.
        EXPECT_GE(largest, packed.half_step((k + 0.5) / 256) - 1.05 / 65280) << k;
    }
}

TEST(MayBeConverted, HoldsForThePackedCodeOfEachDepth)
{
    Depths depths;
    const DepthCoding packed = DepthCoding::packed();
    for (int i = 0; i < 100'000; ++i) {
        const double depth = i % 2 == 0 ? depths.next_even() : double{depths.next()};
        const std::uint32_t code = packed.nearest_code(depth);
        ASSERT_TRUE(may_be_converted(packed, code, depth, depth)) << depth;
        const double other = depth + 0x1p-20;
        ASSERT_TRUE(may_be_converted(packed, code, depth - 0x1p-21, other));
        // The two digits that share a byte are 1/256 apart, so no other depth is this near.
        ASSERT_FALSE(may_be_converted(packed, code, other, other + 0x1p-20)) << depth;
    }
}

TEST(MayBeConverted, KnowsBothDigitsOfTheSharedByte)
{
    const DepthCoding packed = DepthCoding::packed();
    const std::uint32_t code = packed.nearest_code(128 / 256.0);
    EXPECT_EQ(packed.nearest_code(129 / 256.0), code);
    EXPECT_TRUE(may_be_converted(packed, code, 128 / 256.0, 128 / 256.0));
    EXPECT_TRUE(may_be_converted(packed, code, 129 / 256.0, 129 / 256.0));
    EXPECT_FALSE(may_be_converted(packed, code, 128.5 / 256, 128.6 / 256));
    EXPECT_FALSE(may_be_converted(packed, 0xFF000000, 0, 1)); // no digit has the byte 255
}

TEST(TexelClass, OfPackedBytesIsThatOfTheFloat32sAboutTheDepth)
{
    const DepthCoding packed = DepthCoding::packed();
    const double exact = 0.3; // between two float32s
    const auto class_of = [&](float z, double bound) {
        return classify_texel(packed, {exact, bound, packed.nearest_code(double{z})});
    };
    const auto nearest = static_cast<float>(exact);
    const float beyond = nearest + 0x1p-20F;
    EXPECT_EQ(class_of(nearest, 0), TexelClass::nearest_code);
    EXPECT_EQ(class_of(beyond, 0), TexelClass::outside);
    EXPECT_EQ(class_of(beyond, 0x1p-19), TexelClass::within_model);
}

const DepthCoding u16 = DepthCoding::unorm(16);
const DepthCoding d32 = DepthCoding::unorm(32);

CodeRange converted(const DepthCoding& coding, double depth)
{
    return converted_codes(coding, depth, depth);
}

/// The ways to convert a float32 depth to 32 bits: exactly, with any rounding; by a product with
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
            // 1 overflows the doubled integer to 0; without its highest bit it is 2^32 − 1.
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
    EXPECT_TRUE(reaches_lower); // a driver really gives the second code down
}

} // namespace
} // namespace gnomon::analysis
