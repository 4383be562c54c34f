#include "analysis/lookup/critical_bias.hpp"
#include "analysis/lookup/taps.hpp"
#include "lookup_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

/// A pcf3 lookup in a 4×4 map with distinct depths: texel (x, y) from the lower left holds (1 + x +
/// 4y) / 32.
struct Pcf {
    scene::Image<float> map{{4, 4}};
    LookupRule rule = rule_of(scene::Filter::pcf3);

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
        return deciding_samples(layers_of({sample}), {{}, texels}, map, rule).samples[0].map_depth;
    }
};

constexpr scene::LookupSample receiver{0.5F, 0.25F, 0, 0};
constexpr scene::LookupSample centre_outside{0.5F, std::numeric_limits<float>::quiet_NaN(), 0, 0};

TEST(DecidingSamples, TakeTheMedianTap)
{
    const Pcf pcf;
    // Around (1, 1) and (2, 2) depth increases along rows and columns, so the centre is the median.
    EXPECT_EQ(pcf.deciding(receiver, {1.99F, 1.0F}), Pcf::depth(1, 1));
    EXPECT_EQ(pcf.deciding(receiver, {2.5F, 2.5F}), Pcf::depth(2, 2));
}

TEST(DecidingSamples, CountTapsOutsideByTheBorderMode)
{
    Pcf pcf;
    // Around (0, 0) four taps are inside: 1, 2, 5, 6 of 32; five are outside and decide.
    for (const auto outside : {scene::Outside::lit, scene::Outside::shadowed}) {
        pcf.rule.outside = outside;
        EXPECT_TRUE(std::isnan(pcf.deciding(receiver, {0.5F, 0.5F})));
    }
    // Around (1, 0) six taps are inside: 1, 2, 3, 5, 6, 7 of 32. With three lit outside, two more
    // are needed: the farthest two. With three shadowed outside, five of the six are needed.
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
    // The centre (1, -1) is outside; three of nine taps are inside, so the border has a majority.
    EXPECT_TRUE(std::isnan(pcf.deciding(centre_outside, {1.5F, -0.5F})));
    pcf.rule.traits = methods::filter_traits(scene::Filter::pcf5);
    // The centre (2, -1) of 5×5 taps: rows 0 and 1, columns 0 to 3, eight taps of 25.
    EXPECT_TRUE(std::isnan(pcf.deciding(centre_outside, {2.5F, -0.5F})));
    pcf.rule.outside = scene::Outside::clamp;
    // Clamped: four rows of 1, 2, 3, 4, 4 and one of 5, 6, 7, 8, 8: the 13th of 25 is a 4.
    EXPECT_EQ(pcf.deciding(receiver, {2.5F, -0.5F}), 4.0F / 32.0F);
}

TEST(DecidingSamples, LeaveTheWholeReceiverToTheBorderModeBeyondFar)
{
    Pcf pcf;
    const float nan = std::nanf("");
    EXPECT_TRUE(std::isnan(pcf.deciding({1.5F, nan, 0, 1}, {1.5F, 1.5F})));
    EXPECT_TRUE(std::isnan(pcf.deciding({nan, nan, 0, 1}, {nan, nan})));
    // Behind a spot r may round to the far plane: the lookup read no centre tap.
    EXPECT_TRUE(std::isnan(pcf.deciding({1.0F, nan, 0, 1}, {1.5F, 1.5F})));
    pcf.rule.reversed = true;
    EXPECT_TRUE(std::isnan(pcf.deciding({-0.5F, nan, 0, 1}, {1.5F, 1.5F})));
}

/// Counts like the shader.
int count_lit_taps(const Pcf& pcf, scene::Vec2f texel, float r, float bias)
{
    const auto is_lit = [&](int x, int y) {
        const bool is_outside = x < 0 || y < 0 || x > 3 || y > 3;
        if (is_outside && pcf.rule.outside != scene::Outside::clamp) {
            return pcf.rule.outside == scene::Outside::lit;
        }
        const float d = pcf.map(std::clamp(x, 0, 3), 3 - std::clamp(y, 0, 3));
        return pcf.rule.reversed ? r + bias >= d : r - bias <= d;
    };
    const int radius = pcf.rule.traits.width_texels / 2;
    int lit = 0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            lit += is_lit(static_cast<int>(std::floor(texel.x)) + x,
                          static_cast<int>(std::floor(texel.y)) + y)
                       ? 1
                       : 0;
        }
    }
    return lit;
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
        pcf.rule.traits =
            methods::filter_traits(random() % 2 == 0 ? scene::Filter::pcf3 : scene::Filter::pcf5);
        pcf.rule.outside = static_cast<scene::Outside>(random() % 3);
        pcf.rule.reversed = random() % 2 == 0;
        const scene::Vec2f texel{coordinate(random), coordinate(random)};
        const float r = static_cast<float>(random() % 15) / 14.0F;
        const float bias = static_cast<float>(random() % 9) / 14.0F - 0.25F;
        // If the map depth is not NaN, the border never decides for a receiver between near and
        // far.
        const scene::Image<scene::Vec2f> texels{{1, 1}, texel};
        const auto decided =
            deciding_samples(layers_of({{r, 0.5F, 0, 0}}), {{}, texels}, pcf.map, pcf.rule);
        const float critical = critical_biases(decided, pcf.rule)[0];
        const int width = pcf.rule.traits.width_texels;
        const int lit = count_lit_taps(pcf, texel, r, bias);
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
        const auto samples = deciding_samples(lookup, {}, {}, rule_of(filter)).samples;
        EXPECT_EQ(samples[0].map_depth, 0.25F);
        EXPECT_EQ(samples[0].tan_theta, 0.125F);
    }
}

TEST(DecidingSamples, RejectHardwareAndImagesThatDoNotFit)
{
    const auto lookup = layers_of({receiver});
    const scene::Image<scene::Vec2f> texels{{1, 1}};
    const scene::Image<float> map{{4, 4}};
    EXPECT_THROW(
        (void)deciding_samples(lookup, {{}, texels}, map, rule_of(scene::Filter::hardware)),
        std::invalid_argument);
    const LookupRule pcf = rule_of(scene::Filter::pcf3);
    EXPECT_THROW((void)deciding_samples(lookup, {}, map, pcf), std::invalid_argument);
    EXPECT_THROW((void)deciding_samples(lookup, {{}, texels}, {}, pcf), std::invalid_argument);
    EXPECT_THROW((void)deciding_samples(lookup, {{}, texels}, scene::Image<float>{{4, 2}}, pcf),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
