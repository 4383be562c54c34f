#include "lane.hpp"
#include "scene/depth/depth_format.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::scene {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using boost::multiprecision::cpp_int;

constexpr DepthFormat r32f{DepthFormat::Kind::r32f, 32};
constexpr DepthFormat r16f{DepthFormat::Kind::r16f, 16};
constexpr DepthFormat rgba8{DepthFormat::Kind::rgba8, 32};
constexpr std::uint32_t half_of_one = 0x3C00;

/// A binary16 by its definition: (1 + fraction/2^10)·2^(exponent − 15), or subnormal.
double half_by_definition(std::uint32_t bits)
{
    const auto exponent = static_cast<int>(bits >> 10);
    const double fraction = bits & 0x3FFU;
    return exponent == 0 ? std::ldexp(fraction, -24)
                         : std::ldexp(1024 + fraction, exponent - 15 - 10);
}

/// The half nearest to a value in [0, 1], ties to even, found among all halves. Midpoints have 12
/// significant bits, so they and the comparisons are exact.
std::uint32_t nearest_half(float value)
{
    static const std::vector<double> all = [] {
        std::vector<double> halves;
        for (std::uint32_t bits = 0; bits <= half_of_one; ++bits) {
            halves.push_back(half_by_definition(bits));
        }
        return halves;
    }();
    const auto above = std::ranges::lower_bound(all, double{value});
    const auto upper = static_cast<std::uint32_t>(above - all.begin());
    if (*above == double{value}) {
        return upper;
    }
    const double middle = (all[upper - 1] + all[upper]) / 2;
    return double{value} == middle ? upper - upper % 2 : double{value} < middle ? upper - 1 : upper;
}

/// floor(255·component + ½).
std::uint32_t byte_of(const Rational& component)
{
    const Rational steps = component * 255 + Rational{1, 2};
    return static_cast<std::uint32_t>(cpp_int{numerator(steps) / denominator(steps)});
}

Rational fract(const Rational& value)
{
    return value - cpp_int{numerator(value) / denominator(value)};
}

/// The lessons' packing in rationals.
std::uint32_t packed_by_definition(float value)
{
    if (value == 1) {
        return 0xFFFFFFFF;
    }
    std::array<Rational, 4> c;
    for (std::size_t i = 0; i < 4; ++i) {
        c.at(i) = fract(Rational{value} * (cpp_int{1} << 8 * i));
    }
    const std::array<Rational, 4> next{c[1], c[2], c[3], 0};
    std::uint32_t bytes = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        bytes = bytes << 8U | byte_of(c.at(i) - next.at(i) / 256);
    }
    return bytes;
}

/// C++ divides and adds as in IEEE 754.
float unpacked_by_definition(std::uint32_t bytes)
{
    float sum = 0;
    for (int i = 0; i < 4; ++i) {
        const float share = static_cast<float>(bytes >> (24 - 8 * i) & 0xFFU) / 255.0F;
        sum += std::ldexp(share, -8 * i);
    }
    return std::min(sum, 1.0F);
}

/// Values in [0, 1] of every size: evenly spaced ones, powers of two and their neighbours, and any
/// bits.
std::vector<float> many_values()
{
    const bool is_full = tests::runs_full_tests();
    std::vector<float> values{0.0F, 1.0F, std::nextafter(1.0F, 0.0F)};
    for (int exponent = -149; exponent < 0; ++exponent) {
        const float power = std::ldexp(1.0F, exponent);
        values.insert(values.end(),
                      {power, std::nextafter(power, 0.0F), std::nextafter(power, 1.0F)});
    }
    // Byte boundaries, and points half-way between them.
    const int steps = 255 * (is_full ? 64 : 8);
    for (int i = 0; i <= steps; ++i) {
        const auto value = static_cast<float>(i / static_cast<double>(steps));
        values.insert(values.end(), {value, std::ldexp(value, -8), std::ldexp(value, -24)});
    }
    std::mt19937 random{1};
    for (int i = 0; i < (is_full ? 20'000 : 4'000); ++i) {
        values.push_back(std::bit_cast<float>(
            static_cast<std::uint32_t>(random() % std::bit_cast<std::uint32_t>(1.0F))));
    }
    return values;
}

TEST(HalfCodes, StandForWhatBinary16Says)
{
    for (std::uint32_t bits = 0; bits < 0x7C00; ++bits) { // all that are finite and not negative
        ASSERT_EQ(double{colour_value(r16f, bits)}, half_by_definition(bits)) << bits;
    }
}

TEST(HalfCodes, AreTheirOwnRounding)
{
    for (std::uint32_t bits = 0; bits < 0x7C00; ++bits) {
        ASSERT_EQ(colour_code(r16f, colour_value(r16f, bits)), bits);
    }
}

TEST(HalfCodes, RoundToTheNearestAndTiesToTheEvenOne)
{
    for (std::uint32_t bits = 0; bits < half_of_one; ++bits) {
        const auto middle =
            static_cast<float>((half_by_definition(bits) + half_by_definition(bits + 1)) / 2);
        ASSERT_EQ(colour_code(r16f, middle), bits + bits % 2) << bits;
        ASSERT_EQ(colour_code(r16f, std::nextafter(middle, 0.0F)), bits);
        ASSERT_EQ(colour_code(r16f, std::nextafter(middle, 1.0F)), bits + 1);
    }
    for (const float value : many_values()) {
        ASSERT_EQ(colour_code(r16f, value), nearest_half(value)) << value;
    }
}

TEST(PackedCodes, AreTheLessonsBytes)
{
    for (const float value : many_values()) {
        ASSERT_EQ(colour_code(rgba8, value), packed_by_definition(value)) << value;
    }
}

TEST(PackedCodes, StandForTheLessonsSum)
{
    for (const float value : many_values()) {
        const std::uint32_t code = colour_code(rgba8, value);
        ASSERT_EQ(colour_value(rgba8, code), unpacked_by_definition(code)) << value;
    }
}

RC_GTEST_PROP(PackedCodes, StandForTheLessonsSumWhateverTheBytes, ())
{
    const auto bytes = *rc::gen::arbitrary<std::uint32_t>();
    RC_ASSERT(colour_value(rgba8, bytes) == unpacked_by_definition(bytes));
}

TEST(PackedCodes, HoldsTheEndsExactly)
{
    EXPECT_EQ(colour_code(rgba8, 0.0F), 0U);
    EXPECT_EQ(colour_value(rgba8, 0), 0.0F);
    EXPECT_EQ(colour_code(rgba8, 1.0F), 0xFFFFFFFFU); // white
    EXPECT_EQ(colour_value(rgba8, 0xFFFFFFFF), 1.0F);
}

TEST(PackedCodes, DoNotRise)
{
    // 255·128/256 and 255·129/256 round to the same byte.
    EXPECT_EQ(colour_code(rgba8, 128 / 256.0F), colour_code(rgba8, 129 / 256.0F));
    EXPECT_GT(colour_value(rgba8, colour_code(rgba8, std::nextafter(129 / 256.0F, 0.0F))),
              colour_value(rgba8, colour_code(rgba8, 129 / 256.0F)));
}

TEST(PackedCodes, AreHalfAStepOfAByteOffAtMost)
{
    double largest = 0;
    for (const float value : many_values()) {
        const double stored{colour_value(rgba8, colour_code(rgba8, value))};
        largest = std::max(largest, std::abs(stored - double{value}));
    }
    // Each byte's rounding is off by 1/510 of its unit; six roundings to float32 are 2^-25 each.
    EXPECT_LE(largest, (1 + 0x1p-8 + 0x1p-16 + 0x1p-24) / 510 + 6 * 0x1p-25);
    EXPECT_GT(largest, 1.0 / 510);
}

TEST(FloatCodes, AreTheBits)
{
    for (const float value : many_values()) {
        ASSERT_EQ(colour_code(r32f, value), std::bit_cast<std::uint32_t>(value));
        ASSERT_EQ(colour_value(r32f, colour_code(r32f, value)), value);
    }
}

TEST(CodeOfOne, IsTheLargestOfEachFormat)
{
    EXPECT_EQ(code_of_one({DepthFormat::Kind::d16, 16}), 65535U);
    EXPECT_EQ(code_of_one({DepthFormat::Kind::d32, 32}), 0xFFFFFFFFU);
    EXPECT_EQ(code_of_one({DepthFormat::Kind::unorm, 13}), 8191U);
    EXPECT_EQ(code_of_one(float_depth_format), 0x3F800000U);
    EXPECT_EQ(code_of_one(r32f), 0x3F800000U);
    EXPECT_EQ(code_of_one(r16f), half_of_one);
    EXPECT_EQ(code_of_one(rgba8), 0xFFFFFFFFU);
}

TEST(ColourCode, RefusesDepthFormats)
{
    EXPECT_THROW((void)colour_code(float_depth_format, 0.5F), std::invalid_argument);
    EXPECT_THROW((void)colour_value({DepthFormat::Kind::unorm, 8}, 1), std::invalid_argument);
}

TEST(FloatStep, LeadsToTheNextValue)
{
    for (const float depth : {0.0F, 1.0F, 0.5F, 0.75F, 0x1p-20F}) {
        EXPECT_EQ(float_step(r32f, double{depth}),
                  double{std::nextafter(depth, 2.0F)} - double{depth});
    }
    for (std::uint32_t bits = 0; bits <= half_of_one; ++bits) {
        ASSERT_EQ(float_step(r16f, half_by_definition(bits)),
                  half_by_definition(bits + 1) - half_by_definition(bits));
    }
}

} // namespace
} // namespace gnomon::scene
