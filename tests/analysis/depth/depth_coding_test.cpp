#include "analysis/depth/depth_coding.hpp"

#include "analysis/depth/conversion.hpp"
#include "analysis/depth/texel_class.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace gnomon::analysis {
namespace {

using scene::DepthFormat;

/// Any float32 in [0, 1], whatever its size.
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
        // A byte's digits are 1/256 apart where they share it: no other depth is so near.
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

} // namespace
} // namespace gnomon::analysis
