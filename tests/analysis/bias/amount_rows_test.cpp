// Checks amounts at many biases from one lookup, against counting each pixel's taps at each bias.

#include "analysis/bias/amount_rows.hpp"

#include "analysis/lookup/bias_order.hpp"
#include "lookup_case.hpp"
#include "random_biases.hpp"
#include "scene/infinity.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::Filter;
using scene::Outside;
using scene::PixelClass;
using test::random_biases;
using test::random_depth;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A pcfK lookup of some pixels in a small map.
struct Taps {
    scene::Image<PixelClass> classes;
    scene::LookupLayers lookup;
    scene::Image<float> map;
    LookupRule rule;
};

/// Lit taps of a pixel, counted like the shader.
int count_lit_taps(const Taps& taps, std::size_t pixel, float bias)
{
    const scene::LookupSample& sample = taps.lookup.samples[pixel];
    const LookupRule& rule = taps.rule;
    const int radius = rule.traits.width_texels / 2;
    const int side = taps.map.size().width_px;
    const float r = sample.receiver_depth;
    const float whole = bias + rule.slope * sample.tan_theta;
    const bool is_beyond_far = rule.reversed ? r < 0.0F : r > 1.0F;
    int lit = 0;
    for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
            const int column = static_cast<int>(std::floor(taps.lookup.texels[pixel].x)) + x;
            const int row = static_cast<int>(std::floor(taps.lookup.texels[pixel].y)) + y;
            const bool is_outside = column < 0 || row < 0 || column >= side || row >= side;
            if (rule.outside != Outside::clamp && (is_outside || is_beyond_far)) {
                lit += rule.outside == Outside::lit ? 1 : 0;
                continue;
            }
            const float d =
                taps.map(std::clamp(column, 0, side - 1), side - 1 - std::clamp(row, 0, side - 1));
            lit += (rule.reversed ? r + whole >= d : r - whole <= d) ? 1 : 0;
        }
    }
    return lit;
}

Taps random_taps(std::mt19937& random)
{
    constexpr std::array<Filter, 4> filters{Filter::pcf3, Filter::pcf5, Filter::pcf7, Filter::pcf9};
    constexpr std::array<float, 3> slopes{0.0F, 0.0625F, -0.1F};
    const int side = 1 + static_cast<int>(random() % 12);
    const scene::ImageSize size{1 + static_cast<int>(random() % 4),
                                1 + static_cast<int>(random() % 4)};
    Taps taps{scene::Image<PixelClass>{size},
              {scene::Image<scene::LookupSample>{size}, scene::Image<scene::Vec2f>{size}},
              scene::Image<float>{{side, side}},
              rule_of(filters.at(random() % 4), static_cast<Outside>(random() % 3),
                      random() % 2 == 0, slopes.at(random() % 3))};
    for (std::size_t i = 0; i < taps.map.pixel_count(); ++i) {
        taps.map[i] = random_depth(random);
    }
    std::uniform_real_distribution<float> coordinate{-6.0F, static_cast<float>(side) + 6.0F};
    constexpr std::array<PixelClass, 3> classes{PixelClass::lit, PixelClass::blocked,
                                                PixelClass::attached};
    for (std::size_t i = 0; i < taps.classes.pixel_count(); ++i) {
        taps.classes[i] = classes.at(random() % 3);
        taps.lookup.texels[i] = {coordinate(random), coordinate(random)};
        const bool is_outside = random() % 6 == 0 && taps.rule.outside != Outside::clamp;
        taps.lookup.samples[i] = {random_depth(random) + (is_outside ? 1.0F : 0.0F), 0.5F,
                                  static_cast<float>(random() % 3) * 0.5F, 0};
    }
    return taps;
}

TapCriticals criticals_of(const Taps& taps)
{
    return {taps.lookup, taps.map, taps.rule};
}

/// A lit and a blocked pixel in front of nine texels, one of which is not nearer to the light.
Taps two_pixels()
{
    Taps taps{scene::Image<PixelClass>{{2, 1}},
              {scene::Image<scene::LookupSample>{{2, 1}, {0.75F, 0.25F, 0, 0}},
               scene::Image<scene::Vec2f>{{2, 1}, {1.5F, 1.5F}}},
              scene::Image<float>{{3, 3}, 0.25F},
              rule_of(Filter::pcf3)};
    taps.classes[0] = PixelClass::lit;
    taps.classes[1] = PixelClass::blocked;
    taps.map(2, 0) = 0.75F;
    return taps;
}

TEST(SumAmounts, AddsTheTapsThatDisagreeWithTheTruth)
{
    Taps taps = two_pixels();
    // Without bias one tap of nine is lit: the blocked pixel is partial, by a ninth.
    const std::vector<float> biases{0.0F, previous_bias(0.5F), 0.5F};
    EXPECT_THAT(sum_amounts(taps.classes, criticals_of(taps), biases),
                ElementsAre(ErrorAmounts{8.0 / 9, 1.0 / 9, 1, 0},
                            ErrorAmounts{8.0 / 9, 1.0 / 9, 1, 0}, ErrorAmounts{0, 1, 0, 0}));
    taps.classes[1] = PixelClass::attached;
    EXPECT_THAT(sum_amounts(taps.classes, criticals_of(taps), biases),
                ElementsAre(ErrorAmounts{8.0 / 9, 0, 0, 0}, ErrorAmounts{8.0 / 9, 0, 0, 0},
                            ErrorAmounts{}));
}

TEST(SumAmounts, OfOneComparisonAreItsCounts)
{
    const scene::Image<float> criticals{{2, 1}, 0.5F};
    scene::Image<PixelClass> classes{{2, 1}, PixelClass::lit};
    classes[1] = PixelClass::blocked;
    const std::vector<float> biases{0.25F, 0.5F};
    EXPECT_THAT(sum_amounts(BiasCurve{criticals, classes}, biases),
                ElementsAre(ErrorAmounts{1, 0, 0, 0}, ErrorAmounts{0, 1, 0, 0}));
}

TEST(SumAmounts, AgreesWithCountingEachBiasByItself)
{
    std::mt19937 random{32};
    for (int round = 0; round < 1000; ++round) {
        const Taps taps = random_taps(random);
        std::vector<float> some;
        for (int i = 0; i < 6; ++i) {
            some.push_back(random_depth(random) - random_depth(random));
        }
        const auto biases = random_biases(random, some);
        const auto amounts = sum_amounts(taps.classes, criticals_of(taps), biases);
        const auto counts = count_lit_taps(taps.classes, criticals_of(taps), biases);
        ASSERT_EQ(amounts.size(), biases.size());
        const int all = taps.rule.traits.equal_taps();
        for (std::size_t i = 0; i < biases.size(); ++i) {
            std::array<int, 2> wrong{};
            std::uint64_t partial = 0;
            for (std::size_t pixel = 0; pixel < taps.classes.pixel_count(); ++pixel) {
                const int lit = count_lit_taps(taps, pixel, biases[i]);
                const PixelClass truth = taps.classes[pixel];
                const bool is_scored = scene::is_scored(truth);
                ASSERT_EQ(counts[i][pixel], is_scored ? lit : 0);
                if (is_scored) {
                    const int off = truth == PixelClass::lit ? all - lit : lit;
                    wrong.at(truth == PixelClass::lit ? 0 : 1) += off;
                    const bool is_right = (2 * lit >= all) == (truth == PixelClass::lit);
                    partial += is_right && off > 0 ? 1 : 0;
                }
            }
            const ErrorAmounts expected{static_cast<double>(wrong[0]) / all,
                                        static_cast<double>(wrong[1]) / all, partial, 0};
            ASSERT_EQ(amounts[i], expected)
                << fmt::format("round {}, bias {}: {} and {} taps of {}, {} partial", round,
                               biases[i], wrong[0], wrong[1], all, partial);
        }
    }
}

TEST(SumAmounts, RejectsBiasesThatDoNotAscend)
{
    const Taps taps = two_pixels();
    EXPECT_THAT(sum_amounts(taps.classes, criticals_of(taps), {}), IsEmpty());
    for (const std::vector<float>& biases :
         {std::vector<float>{1.0F, 0.5F}, {0.5F, 0.5F}, {-0.0F, 0.0F}}) {
        EXPECT_THROW((void)sum_amounts(taps.classes, criticals_of(taps), biases),
                     std::invalid_argument);
    }
}

TEST(AmountSum, OfTapsIsExactHoweverManyRound)
{
    // float(1/9) is too large by 2.5e-9: over 16 million additions, by a twentieth of a tap.
    AmountSum ninths{9};
    for (int i = 0; i < 16'000'000; ++i) {
        ninths.add(1 - double{8.0F / 9.0F});
    }
    EXPECT_EQ(ninths.value(), 16'000'000.0 / 9);
    AmountSum any{0};
    any.add(0.25);
    any.add(0.125);
    EXPECT_EQ(any.value(), 0.375);
}

} // namespace
} // namespace gnomon::analysis
