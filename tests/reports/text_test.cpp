#include "reports/text/text.hpp"
#include "store/exr/header.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace gnomon::reports {
namespace {

TEST(GroupedAmount, HasThreeDigitsOrMoreAndNoExponent)
{
    EXPECT_EQ(grouped_amount(0), "0");
    EXPECT_EQ(grouped_amount(0.0004), "<0.001");
    EXPECT_EQ(grouped_amount(0.0012), "0.001");
    EXPECT_EQ(grouped_amount(0.25), "0.250");
    EXPECT_EQ(grouped_amount(1.0 / 3 + 1), "1.33");
    EXPECT_EQ(grouped_amount(9.996), "10.0");
    EXPECT_EQ(grouped_amount(12.34), "12.3");
    EXPECT_EQ(grouped_amount(99.96), "100");
    EXPECT_EQ(grouped_amount(999.6), "1,000");
    EXPECT_EQ(grouped_amount(367'863.6), "367,864");
}

TEST(Grouped, SeparatesThousands)
{
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(1'048'578), "1,048,578");
    EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(Percent, ShowsThreeSignificantDigits)
{
    EXPECT_EQ(percent(1.0), "100 %");
    EXPECT_EQ(percent(0.123456), "12.3 %");
    EXPECT_EQ(percent(0.0123456), "1.23 %");
    EXPECT_EQ(percent(0.000123456), "0.0123 %");
}

TEST(Percent, ShowsZeroOnlyForZero)
{
    EXPECT_EQ(percent(0.0), "0 %");
    EXPECT_EQ(percent(1e-9), "<0.0001 %");
}

TEST(Percent, ShowsADashForNoValue)
{
    EXPECT_EQ(percent(std::nullopt), "-");
}

TEST(Pad, CountsCodePointsNotBytes)
{
    EXPECT_EQ(pad_right("θ", 3), "θ  ");
    EXPECT_EQ(pad_left("θ", 3), "  θ");
    EXPECT_EQ(pad_left("long", 3), "long");
}

TEST(FirstColumns, CutsBetweenCodePoints)
{
    EXPECT_EQ(first_columns("θ = 3", 1), "θ");
    EXPECT_EQ(first_columns("aθb", 2), "aθ");
    EXPECT_EQ(first_columns("aθ", 2), "aθ");
    EXPECT_EQ(first_columns("aθ", 9), "aθ");
    EXPECT_EQ(first_columns("θ", 0), "");
    EXPECT_EQ(first_columns("", 3), "");
}

TEST(Counted, TakesThePlural)
{
    EXPECT_EQ(counted(1, "triangle"), "1 triangle");
    EXPECT_EQ(counted(2000, "triangle"), "2,000 triangles");
}

TEST(Hexadecimal, WritesWhatC99Writes)
{
    EXPECT_EQ(store::hexadecimal(3.0), "0x1.8p+1");
    EXPECT_EQ(store::hexadecimal(-0.5), "-0x1p-1");
    EXPECT_EQ(store::hexadecimal(0.0), "0x0p+0");
    EXPECT_EQ(store::hexadecimal(-0.0), "-0x0p+0");
}

RC_GTEST_PROP(Hexadecimal, ReadsBackToTheSameBits, (std::uint64_t bits))
{
    const auto value = std::bit_cast<double>(bits);
    RC_PRE(std::isfinite(value));
    const double back = std::strtod(store::hexadecimal(value).c_str(), nullptr);
    RC_ASSERT(std::bit_cast<std::uint64_t>(back) == bits);
}

} // namespace
} // namespace gnomon::reports
