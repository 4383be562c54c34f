#include "analysis/lookup/critical_bias.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "lookup_case.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>

namespace gnomon::analysis {
namespace {

using scene::infinity;

constexpr float smallest_normal = std::numeric_limits<float>::min();

struct Case {
    float r = 0;
    float d = 0;
    float slope_term = 0;
    bool reversed = false;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << std::hexfloat << "r " << c.r << " d " << c.d << " slope term " << c.slope_term
               << (c.reversed ? " reversed" : "");
}

/// The definition, written like the shader.
bool is_lit(const Case& c, float bias)
{
    const float whole = bias + c.slope_term;
    if (c.reversed) {
        const float biased = c.r + whole;
        return biased >= c.d;
    }
    const float biased = c.r - whole;
    return biased <= c.d;
}

/// Finds it by bisection over all biases in order.
float by_bisection(const Case& c)
{
    if (is_lit(c, bias_of_rank(-largest_bias_rank))) {
        return -infinity;
    }
    std::int64_t shadowed = -largest_bias_rank;
    std::int64_t lit = std::int64_t{largest_bias_rank} + 1;
    while (lit - shadowed > 1) {
        const std::int64_t middle = (lit + shadowed) / 2;
        (is_lit(c, bias_of_rank(static_cast<std::int32_t>(middle))) ? lit : shadowed) = middle;
    }
    return bias_of_rank(static_cast<std::int32_t>(lit));
}

float critical_bias(const Case& c)
{
    return analysis::critical_bias(c.r, c.d, c.slope_term, c.reversed);
}

void expect_critical(const Case& c)
{
    const float b = critical_bias(c);
    if (b == -infinity) {
        ASSERT_TRUE(is_lit(c, bias_of_rank(-largest_bias_rank))) << c;
    } else if (b == infinity) {
        ASSERT_FALSE(is_lit(c, bias_of_rank(largest_bias_rank))) << c;
    } else {
        ASSERT_TRUE(b == 0.0F || std::isnormal(b)) << c << " gives " << b;
        ASSERT_FALSE(b == 0.0F && std::signbit(b)) << c;
        ASSERT_TRUE(is_lit(c, b)) << c << " gives " << b;
        ASSERT_FALSE(is_lit(c, previous_bias(b))) << c << " gives " << b;
    }
}

/// Draws realistic receivers: depths in [0, 1], near each other or not, quantised depths, and exact
/// ties.
class Cases {
public:
    explicit Cases(unsigned seed) : random_{seed} {}

    Case next()
    {
        Case c;
        c.r = depth();
        c.d = random_() % 4 == 0 ? depth() : near(c.r);
        c.slope_term = random_() % 2 == 0 ? 0.0F : slope_term();
        c.reversed = random_() % 2 == 0;
        return c;
    }

private:
    float unit() { return std::uniform_real_distribution<float>{0.0F, 1.0F}(random_); }
    int exponent(int lowest) { return std::uniform_int_distribution<int>{lowest, 0}(random_); }
    float depth()
    {
        switch (random_() % 4) {
        case 0:
            return static_cast<float>(random_() % 65536) / 65535.0F;
        case 1:
            return std::ldexp(unit(), exponent(-30));
        default:
            return unit();
        }
    }
    float near(float r)
    {
        switch (random_() % 4) {
        case 0:
            return r;
        case 1:
            return std::nextafter(r, random_() % 2 == 0 ? 0.0F : 2.0F);
        default:
            return std::fmin(1.0F, std::fmax(0.0F, r + std::ldexp(unit() - 0.5F, exponent(-25))));
        }
    }
    float slope_term() { return std::ldexp(unit() - 0.25F, exponent(-30)); }

    std::mt19937 random_;
};

TEST(BiasOrder, NumbersZeroAndTheNormalFloatsWithoutGaps)
{
    EXPECT_EQ(bias_rank(0.0F), 0);
    EXPECT_EQ(bias_rank(-0.0F), 0);
    EXPECT_EQ(next_bias(0.0F), smallest_normal);
    EXPECT_EQ(previous_bias(0.0F), -smallest_normal);
    EXPECT_EQ(next_bias(-smallest_normal), 0.0F);
    EXPECT_EQ(next_bias(1.0F), std::nextafter(1.0F, 2.0F));
    EXPECT_EQ(previous_bias(-1.0F), std::nextafter(-1.0F, -2.0F));
    EXPECT_EQ(bias_of_rank(largest_bias_rank), std::numeric_limits<float>::max());
    for (const float end : {infinity, -infinity}) {
        EXPECT_EQ(bias_of_rank(bias_rank(end)), end);
    }
    EXPECT_EQ(next_bias(infinity), infinity);
    EXPECT_EQ(previous_bias(-infinity), -infinity);
}

TEST(CriticalBias, IsTheDifferenceUpToTheRoundingThatHelps)
{
    // fl(0.5 − b) <= 0.25: the floats from 0.25 on are 2^-25 apart, and 0.25 + 2^-26 is a tie that
    // rounds down to the even 0.25.
    EXPECT_EQ(critical_bias({0.5F, 0.25F}), 0.25F - 0x1p-26F);
    // 0.25 + 2^-25 is odd: the tie above it rounds away from it, and is still shadowed.
    const float odd = std::nextafter(0.25F, 1.0F);
    EXPECT_EQ(critical_bias({0.5F, odd}), std::nextafter(0.25F - 0x1p-25F - 0x1p-26F, 1.0F));
}

TEST(CriticalBias, IsHalfAnUlpBelowZeroAtEqualDepths)
{
    // 0.5 is even, and the floats above it are 2^-24 apart.
    EXPECT_EQ(critical_bias({0.5F, 0.5F}), -0x1p-25F);
    // Reversed, the floats below 0.5 are 2^-25 apart.
    EXPECT_EQ(critical_bias({0.5F, 0.5F, 0.0F, true}), -0x1p-26F);
    EXPECT_EQ(critical_bias({0.0F, 0.0F}), 0.0F);
    EXPECT_EQ(critical_bias({0.0F, 0.0F, 0.0F, true}), 0.0F);
}

TEST(CriticalBias, TakesTheSlopeTermOff)
{
    EXPECT_EQ(critical_bias({0.5F, 0.25F, 1.0F}), by_bisection({0.5F, 0.25F, 1.0F}));
    EXPECT_EQ(critical_bias({0.5F, 0.25F, 1.0F}), -0.75F - 0x1p-25F);
}

TEST(CriticalBias, IsInfiniteWhereNoBiasMatters)
{
    constexpr float overflow = infinity;
    EXPECT_EQ(critical_bias({0.5F, 0.25F, overflow}), -infinity);
    EXPECT_EQ(critical_bias({0.5F, 0.25F, -overflow}), infinity);
    EXPECT_EQ(critical_bias({0.5F, 0.25F, overflow, true}), -infinity);
    const float nan = std::nanf("");
    EXPECT_EQ(critical_bias({0.5F, nan}), infinity);
    EXPECT_EQ(critical_bias({nan, 0.5F}), infinity);
    EXPECT_EQ(critical_bias({nan, 0.5F, overflow}), infinity);
    EXPECT_EQ(critical_bias({infinity, 0.5F}), infinity);
    EXPECT_EQ(critical_bias({-infinity, 0.5F}), -infinity);
    EXPECT_EQ(critical_bias({infinity, 0.5F, 0.0F, true}), -infinity);
    EXPECT_EQ(critical_bias({-infinity, 0.5F, 0.0F, true}), infinity);
}

TEST(CriticalBias, EqualsBisectionOnAwkwardValues)
{
    constexpr float subnormal = std::numeric_limits<float>::denorm_min();
    const std::array<float, 16> depths{
        0.0F, subnormal, smallest_normal, 0x1p-100F, 0x1p-30F,     0x1p-24F,  0.25F, 0x1.fffffep-2F,
        0.5F, 0.75F,     0x1.fffffep-1F,  1.0F,      0x1.00002p0F, -0x1p-24F, -0.5F, 2.0F};
    const std::array<float, 12> terms{0.0F,   subnormal, -subnormal, smallest_normal,
                                      1e-9F,  -1e-9F,    0.5F,       -0.5F,
                                      1.0e4F, 3.0e38F,   -3.0e38F,   -smallest_normal};
    for (const float r : depths) {
        for (const float d : depths) {
            for (const float term : terms) {
                for (const bool reversed : {false, true}) {
                    const Case c{r, d, term, reversed};
                    ASSERT_EQ(critical_bias(c), by_bisection(c)) << c;
                }
            }
        }
    }
}

TEST(CriticalBias, EqualsBisectionOnRandomReceivers)
{
    Cases cases{1};
    for (int i = 0; i < 100'000; ++i) {
        const Case c = cases.next();
        ASSERT_EQ(critical_bias(c), by_bisection(c)) << c;
    }
}

TEST(CriticalBias, SeparatesLitFromShadowedOnAMillionReceivers)
{
    Cases cases{2};
    for (int i = 0; i < 1'000'000; ++i) {
        ASSERT_NO_FATAL_FAILURE(expect_critical(cases.next()));
    }
}

TEST(CriticalBias, NeverGrowsWithTheMapDepth)
{
    Cases cases{3};
    for (int i = 0; i < 100'000; ++i) {
        const Case c = cases.next();
        Case farther = c;
        farther.d = std::nextafter(c.d, c.reversed ? -1.0F : 2.0F);
        ASSERT_LE(critical_bias(farther), critical_bias(c)) << c;
    }
}

TEST(UnscaledBias, IsTheSmallestThatReachesTheScaledOne)
{
    std::mt19937 random{4};
    std::uniform_real_distribution<float> mantissas{-1, 1};
    std::uniform_int_distribution<int> exponents{-30, 2};
    std::uniform_real_distribution<float> scales{0.05F, 20};
    for (int i = 0; i < 1'000'000; ++i) {
        const float scaled = std::ldexp(mantissas(random), exponents(random));
        const float scale = scales(random);
        const float bias = unscaled_bias(scaled, scale);
        ASSERT_TRUE(bias * scale >= scaled && !(previous_bias(bias) * scale >= scaled))
            << scaled << " by " << scale;
    }
    for (const float end : {-infinity, 0.0F, infinity}) {
        EXPECT_EQ(unscaled_bias(end, 3), end);
    }
    EXPECT_EQ(unscaled_bias(3, 0x1p-126F), 3 * 0x1p126F);
    EXPECT_EQ(unscaled_bias(8, 0x1p-126F), infinity); // no bias is so large
}

TEST(CriticalBiases, MultipliesSlopeAndTangentInFloat32)
{
    LookupRule rule;
    rule.slope = 0.1F;
    const auto result = critical_biases(layers_of({{0.5F, 0.25F, 0.3F, 0}}), rule);
    EXPECT_EQ(result[0], critical_bias({0.5F, 0.25F, 0.1F * 0.3F}));
}

TEST(CriticalBiases, AreInfiniteWhereTheBorderDecides)
{
    const auto border = layers_of({{2.0F, std::nanf(""), 0, 1}});
    EXPECT_EQ(critical_biases(border, {.outside = scene::Outside::lit})[0], -infinity);
    EXPECT_EQ(critical_biases(border, {.outside = scene::Outside::shadowed})[0], infinity);
}

} // namespace
} // namespace gnomon::analysis
