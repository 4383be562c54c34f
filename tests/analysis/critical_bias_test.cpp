#include "analysis/critical_bias.hpp"

#include "analysis/bias_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
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

/// The definition itself, written as the shader writes it.
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

/// Bisection over all biases in order.
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

/// Draws receivers as they occur: depths in [0, 1], near each other or not, codes of a format, and
/// exact ties.
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

scene::LookupLayers layers_of(const std::vector<scene::LookupSample>& samples)
{
    scene::LookupLayers layers{
        scene::Image<scene::LookupSample>{{static_cast<int>(samples.size()), 1}}};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        layers.samples[i] = samples[i];
    }
    return layers;
}

TEST(CriticalBiases, MultipliesSlopeAndTangentInFloat32)
{
    LookupRule rule;
    rule.slope = 0.1F;
    const auto result = critical_biases(layers_of({{0.5F, 0.25F, 0.3F, 0}}), rule);
    EXPECT_EQ(result[0], critical_bias({0.5F, 0.25F, 0.1F * 0.3F}));
}

TEST(CriticalBiases, AreInfiniteWhereThePolicyDecides)
{
    const auto policy = layers_of({{2.0F, std::nanf(""), 0, 1}});
    EXPECT_EQ(critical_biases(policy, {.outside = scene::Outside::lit})[0], -infinity);
    EXPECT_EQ(critical_biases(policy, {.outside = scene::Outside::shadowed})[0], infinity);
}

/// A pcf3 lookup in a 4×4 map whose depths are distinct: texel (x, y) from the lower left holds
/// (1 + x + 4y) / 32.
struct Pcf {
    scene::Image<float> map{{4, 4}};
    LookupRule rule{scene::Filter::pcf3};

    Pcf()
    {
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 4; ++x) {
                map(x, 3 - y) = depth(x, y);
            }
        }
    }
    static float depth(int x, int y) { return static_cast<float>(1 + x + 4 * y) / 32.0F; }
    [[nodiscard]] float deciding(scene::LookupSample sample, scene::Vec2f texel) const
    {
        const scene::Image<scene::Vec2f> texels{{1, 1}, texel};
        return deciding_samples(layers_of({sample}), texels, map, rule).samples[0].map_depth;
    }
};

constexpr scene::LookupSample receiver{0.5F, 0.25F, 0, 0};
constexpr scene::LookupSample centre_outside{0.5F, std::numeric_limits<float>::quiet_NaN(), 0, 0};

TEST(DecidingSamples, TakeTheMedianTap)
{
    const Pcf pcf;
    // Around (1, 1) and (2, 2) depth grows along rows and columns alike: the centre is the median.
    EXPECT_EQ(pcf.deciding(receiver, {1.99F, 1.0F}), Pcf::depth(1, 1));
    EXPECT_EQ(pcf.deciding(receiver, {2.5F, 2.5F}), Pcf::depth(2, 2));
}

TEST(DecidingSamples, CountTapsOutsideByThePolicy)
{
    Pcf pcf;
    // Around (0, 0) four taps are inside: 1, 2, 5, 6 of 32; five are outside and decide.
    for (const auto outside : {scene::Outside::lit, scene::Outside::shadowed}) {
        pcf.rule.outside = outside;
        EXPECT_TRUE(std::isnan(pcf.deciding(receiver, {0.5F, 0.5F})));
    }
    // Around (1, 0) six are inside: 1, 2, 3, 5, 6, 7 of 32. Three lit ones beside leave two to
    // find: the farthest two; three shadowed ones need five of the six.
    pcf.rule.outside = scene::Outside::lit;
    EXPECT_EQ(pcf.deciding(receiver, {1.5F, 0.5F}), 6.0F / 32.0F);
    pcf.rule.outside = scene::Outside::shadowed;
    EXPECT_EQ(pcf.deciding(receiver, {1.5F, 0.5F}), 2.0F / 32.0F);
    pcf.rule.reversed = true;
    EXPECT_EQ(pcf.deciding(receiver, {1.5F, 0.5F}), 6.0F / 32.0F);
}

TEST(DecidingSamples, ReachIntoTheMapFromOutside)
{
    Pcf pcf;
    // The centre (1, -1) is outside; three of nine taps are inside, so the policy has a majority.
    EXPECT_TRUE(std::isnan(pcf.deciding(centre_outside, {1.5F, -0.5F})));
    pcf.rule.filter = scene::Filter::pcf5;
    // The centre (2, -1) of 5×5 taps: rows 0 and 1, columns 0 to 3, eight taps of 25.
    EXPECT_TRUE(std::isnan(pcf.deciding(centre_outside, {2.5F, -0.5F})));
    pcf.rule.outside = scene::Outside::clamp;
    // Clamped: four rows of 1, 2, 3, 4, 4 and one of 5, 6, 7, 8, 8: the 13th of 25 is a 4.
    EXPECT_EQ(pcf.deciding(receiver, {2.5F, -0.5F}), 4.0F / 32.0F);
}

TEST(DecidingSamples, LeaveTheWholeReceiverToThePolicyBeyondFar)
{
    Pcf pcf;
    const float nan = std::nanf("");
    EXPECT_TRUE(std::isnan(pcf.deciding({1.5F, nan, 0, 1}, {1.5F, 1.5F})));
    EXPECT_TRUE(std::isnan(pcf.deciding({nan, nan, 0, 1}, {nan, nan})));
    // Behind a spot, where r may round to the far plane: the lookup never came to its centre tap.
    EXPECT_TRUE(std::isnan(pcf.deciding({1.0F, nan, 0, 1}, {1.5F, 1.5F})));
    pcf.rule.reversed = true;
    EXPECT_TRUE(std::isnan(pcf.deciding({-0.5F, nan, 0, 1}, {1.5F, 1.5F})));
}

TEST(DecidingSamples, AgreeWithCountingLitTaps)
{
    std::mt19937 random{4};
    std::uniform_real_distribution<float> coordinate{-3.0F, 7.0F};
    for (int i = 0; i < 20'000; ++i) {
        Pcf pcf;
        for (std::size_t t = 0; t < 16; ++t) {
            pcf.map[t] = static_cast<float>(random() % 8) / 7.0F;
        }
        const int width = random() % 2 == 0 ? 3 : 5;
        pcf.rule.filter = width == 3 ? scene::Filter::pcf3 : scene::Filter::pcf5;
        pcf.rule.outside = static_cast<scene::Outside>(random() % 3);
        pcf.rule.reversed = random() % 2 == 0;
        const scene::Vec2f texel{coordinate(random), coordinate(random)};
        const float r = static_cast<float>(random() % 15) / 14.0F;
        const float bias = static_cast<float>(random() % 9) / 14.0F - 0.25F;
        const scene::LookupSample sample{r, 0.5F, 0, 0};
        const auto outcome = [&](int x, int y) {
            const bool clamps = pcf.rule.outside == scene::Outside::clamp;
            if (!clamps && (x < 0 || y < 0 || x > 3 || y > 3)) {
                return pcf.rule.outside == scene::Outside::lit;
            }
            const float d = pcf.map(std::clamp(x, 0, 3), 3 - std::clamp(y, 0, 3));
            return is_lit({r, d, 0, pcf.rule.reversed}, bias);
        };
        int lit = 0;
        for (int y = -width / 2; y <= width / 2; ++y) {
            for (int x = -width / 2; x <= width / 2; ++x) {
                lit += outcome(static_cast<int>(std::floor(texel.x)) + x,
                               static_cast<int>(std::floor(texel.y)) + y)
                           ? 1
                           : 0;
            }
        }
        // With a map depth that is no NaN, a receiver inside near and far never is the policy's.
        const scene::Image<scene::Vec2f> texels{{1, 1}, texel};
        const auto decided = deciding_samples(layers_of({sample}), texels, pcf.map, pcf.rule);
        const float critical = critical_biases(decided, pcf.rule)[0];
        ASSERT_EQ(scene::is_lit(static_cast<float>(lit) / static_cast<float>(width * width)),
                  critical <= bias)
            << "case " << i << " texel " << texel.x << ", " << texel.y << " r " << r << " bias "
            << bias;
    }
}

TEST(DecidingSamples, AreTheLookupsOwnForOneComparison)
{
    const auto lookup = layers_of({{0.5F, 0.25F, 0.125F, 1}});
    for (const auto filter : {scene::Filter::nearest, scene::Filter::linear}) {
        const auto samples = deciding_samples(lookup, {}, {}, {filter}).samples;
        EXPECT_EQ(samples[0].map_depth, 0.25F);
        EXPECT_EQ(samples[0].tan_theta, 0.125F);
    }
}

TEST(DecidingSamples, RejectHardwareAndImagesThatDoNotFit)
{
    const auto lookup = layers_of({receiver});
    const scene::Image<scene::Vec2f> texels{{1, 1}};
    const scene::Image<float> map{{4, 4}};
    EXPECT_THROW((void)deciding_samples(lookup, texels, map, {scene::Filter::hardware}),
                 std::invalid_argument);
    const LookupRule pcf{scene::Filter::pcf3};
    EXPECT_THROW((void)deciding_samples(lookup, {}, map, pcf), std::invalid_argument);
    EXPECT_THROW((void)deciding_samples(lookup, texels, {}, pcf), std::invalid_argument);
    EXPECT_THROW((void)deciding_samples(lookup, texels, scene::Image<float>{{4, 2}}, pcf),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
