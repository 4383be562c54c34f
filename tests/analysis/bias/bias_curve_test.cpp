#include "analysis/bias/bias_curve.hpp"

#include "analysis/pixels/radix_sort.hpp"
#include "curve_case.hpp"
#include "scene/infinity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using scene::PixelClass;
using testing::ElementsAre;

using PixelClass::blocked;
using PixelClass::lit;

TEST(RadixSort, OrdersFloatsAsTheirValues)
{
    std::mt19937 random{1};
    for (const std::size_t count : {0U, 1U, 2U, 1000U, 100'000U}) {
        std::vector<float> values(count);
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = bias_of_rank(static_cast<std::int32_t>(random() % 0x7F000001) *
                                     (random() % 2 == 0 ? 1 : -1));
            values[i] = random() % 100 == 0 ? -infinity : values[i];
        }
        std::vector<float> expected = values;
        std::sort(expected.begin(), expected.end());
        radix_sort(values);
        EXPECT_EQ(values, expected);
    }
    EXPECT_EQ(sort_key(-0.0F), sort_key(0.0F));
    EXPECT_EQ(value_of_key(sort_key(-infinity)), -infinity);
    EXPECT_EQ(value_of_key(sort_key(0.1F)), 0.1F);
}

TEST(RadixSort, KeepsTheOrderOfEqualKeys)
{
    std::mt19937 random{2};
    std::vector<std::pair<std::uint32_t, int>> items(10'000);
    for (int i = 0; i < 10'000; ++i) {
        items[static_cast<std::size_t>(i)] = {static_cast<std::uint32_t>(random() % 50) << 20, i};
    }
    radix_sort(items, [](const auto& item) { return item.first; });
    EXPECT_TRUE(std::is_sorted(items.begin(), items.end()));
}

TEST(BiasCurve, CountsLitPixelsAboveAndBlockedPixelsUpToABias)
{
    const BiasCurve curve =
        CurveImages{{{lit, 0.25F}, {lit, 0.5F}, {blocked, 0.5F}, {PixelClass::attached, 9.0F}}}
            .curve();
    EXPECT_EQ(curve.scored(), 3U);
    EXPECT_EQ(curve.at(0.0F), (ErrorCounts{2, 0}));
    EXPECT_EQ(curve.at(0.25F), (ErrorCounts{1, 0}));
    EXPECT_EQ(curve.at(previous_bias(0.5F)), (ErrorCounts{1, 0}));
    EXPECT_EQ(curve.at(0.5F), (ErrorCounts{0, 1}));
    EXPECT_EQ(curve.false_shadow_rate(curve.at(0.25F)), 0.5);
    EXPECT_EQ(curve.false_lit_rate(curve.at(0.5F)), 1.0);
    EXPECT_EQ(curve.error_rate(curve.at(0.5F)), 1.0 / 3.0);
}

TEST(BiasCurve, EqualsDirectCountingAtEveryTellingBias)
{
    std::mt19937 random{3};
    for (int i = 0; i < 2000; ++i) {
        const auto pixels = random_pixels(random);
        const BiasCurve curve = CurveImages{pixels}.curve();
        for (const float bias : telling_biases(pixels)) {
            ASSERT_EQ(curve.at(bias), count_errors(pixels, bias)) << "case " << i << " at " << bias;
        }
    }
}

TEST(BiasCurve, LeavesRatesWithoutADenominatorEmpty)
{
    const BiasCurve none = CurveImages{{{PixelClass::background}}}.curve();
    const ErrorCounts errors = none.at(0.0F);
    EXPECT_EQ(errors, ErrorCounts{});
    EXPECT_FALSE(none.error_rate(errors) || none.false_shadow_rate(errors) ||
                 none.false_lit_rate(errors));
}

TEST(BiasCurve, RejectsBiasesThatNoLookupTakes)
{
    const BiasCurve curve = CurveImages{{{lit, 0.25F}}}.curve();
    for (const float bad :
         {infinity, -infinity, std::nanf(""), std::numeric_limits<float>::denorm_min()}) {
        EXPECT_THROW((void)curve.at(bad), std::invalid_argument) << bad;
    }
}

TEST(BiasCurve, RejectsNanAndImagesOfDifferentSize)
{
    const CurveImages scored{{{lit, std::nanf("")}}};
    const CurveImages unscored{{{PixelClass::attached, std::nanf("")}}};
    EXPECT_THROW((void)scored.curve(), std::invalid_argument);
    EXPECT_NO_THROW((void)unscored.curve());
    EXPECT_THROW((void)BiasCurve({}, scene::Image<PixelClass>{{1, 1}}), std::invalid_argument);
}

TEST(BestBiases, ReachFromTheLastAcneToTheFirstPanning)
{
    const auto best = find_best_biases(
        CurveImages{{{lit, 0.125F}, {lit, 0.25F}, {blocked, 0.5F}, {blocked, 1.0F}}}.curve());
    EXPECT_EQ(best.interval, (BiasInterval{0.25F, previous_bias(0.5F)}));
    EXPECT_EQ(best.errors, ErrorCounts{});
}

TEST(BestBiases, AreUnlimitedWhereNothingLimitsThem)
{
    const auto only_lit = find_best_biases(CurveImages{{{lit, 0.125F}}}.curve());
    EXPECT_EQ(only_lit.interval, (BiasInterval{0.125F, infinity}));
    const auto only_blocked = find_best_biases(CurveImages{{{blocked, 0.5F}}}.curve());
    EXPECT_EQ(only_blocked.interval, (BiasInterval{-infinity, previous_bias(0.5F)}));
    for (const auto& pixels : {std::vector<CurvePixel>{{lit, -infinity}, {blocked, infinity}},
                               std::vector<CurvePixel>{{lit, infinity}, {blocked, -infinity}},
                               std::vector<CurvePixel>{{PixelClass::background, 0}}}) {
        const auto all = find_best_biases(CurveImages{pixels}.curve());
        EXPECT_EQ(all.interval, (BiasInterval{-infinity, infinity}));
        EXPECT_EQ(all.interval.middle(), 0.0F);
    }
}

TEST(BestBiases, AreTheWidestOfSeveralAndThenTheLowest)
{
    // One error in [1, 2) and in [3, 5).
    const auto widest =
        find_best_biases(CurveImages{{{lit, 1}, {blocked, 2}, {lit, 3}, {blocked, 5}}}.curve());
    EXPECT_EQ(widest.interval, (BiasInterval{3, previous_bias(5)}));
    EXPECT_EQ(widest.errors.total(), 1U);
    // One error in [1, 1.25) and in [1.5, 1.75), where floats have equal spacing.
    const auto lowest = find_best_biases(
        CurveImages{{{lit, 1}, {blocked, 1.25F}, {lit, 1.5F}, {blocked, 1.75F}}}.curve());
    EXPECT_EQ(lowest.interval, (BiasInterval{1, previous_bias(1.25F)}));
}

TEST(BestBiases, JoinNeighboursOfEqualCount)
{
    // At 0.5 a lit pixel becomes right and a blocked one wrong: both sides have equally many
    // errors.
    const auto best = find_best_biases(
        CurveImages{{{lit, 0.25F}, {lit, 0.5F}, {blocked, 0.5F}, {blocked, 0.75F}}}.curve());
    EXPECT_EQ(best.interval, (BiasInterval{0.25F, previous_bias(0.75F)}));
    EXPECT_EQ(best.errors, (ErrorCounts{1, 0}));
}

TEST(BestBiases, HaveTheFewestErrorsOfAllBiases)
{
    std::mt19937 random{5};
    for (int i = 0; i < 2000; ++i) {
        const auto pixels = random_pixels(random);
        const BestBiases best = find_best_biases(CurveImages{pixels}.curve());
        for (const float bias : telling_biases(pixels)) {
            const std::uint64_t errors = count_errors(pixels, bias).total();
            ASSERT_GE(errors, best.errors.total()) << "case " << i << " at " << bias;
            if (best.interval.lo <= bias && bias <= best.interval.hi) {
                ASSERT_EQ(errors, best.errors.total()) << "case " << i << " at " << bias;
            }
        }
        for (const float beyond : {previous_bias(best.interval.lo), next_bias(best.interval.hi)}) {
            if (std::isfinite(beyond)) {
                ASSERT_GT(count_errors(pixels, beyond).total(), best.errors.total())
                    << "case " << i << " at " << beyond;
            }
        }
    }
}

TEST(BiasInterval, HasAMiddle)
{
    EXPECT_EQ((BiasInterval{0.25F, 0.75F}.middle()), 0.5F);
    EXPECT_EQ((BiasInterval{-infinity, 0.75F}.middle()), 0.75F);
    EXPECT_EQ((BiasInterval{0.25F, infinity}.middle()), 0.25F);
    EXPECT_EQ((BiasInterval{0.0F, std::numeric_limits<float>::min()}.middle()), 0.0F);
}

TEST(BestBiases, AreSoughtWithinAnInterval)
{
    const BiasCurve curve = CurveImages{{{lit, 1}, {blocked, 2}, {lit, 3}, {blocked, 5}}}.curve();
    // Errors: 2 below 1, 1 from 1, 2 from 2, 1 from 3, 2 from 5.
    const auto low = find_best_biases(curve, {0.5F, 2.5F});
    EXPECT_EQ(low.interval, (BiasInterval{1, previous_bias(2)}));
    EXPECT_EQ(low.errors.total(), 1U);
    const auto cut = find_best_biases(curve, {3.5F, 4});
    EXPECT_EQ(cut.interval, (BiasInterval{3.5F, 4}));
    const auto point = find_best_biases(curve, {2, 2});
    EXPECT_EQ(point.interval, (BiasInterval{2, 2}));
    EXPECT_EQ(point.errors.total(), 2U);
    EXPECT_THROW((void)find_best_biases(curve, {2, 1}), std::invalid_argument);
}

TEST(BiasesWithAtMost, LieBetweenTheCriticalBiasesThatTheCountsAllow)
{
    const BiasCurve curve = CurveImages{{{lit, 1}, {blocked, 2}, {lit, 3}, {blocked, 5}}}.curve();
    EXPECT_EQ(biases_with_at_most(curve, {1, 0}), (BiasInterval{1, previous_bias(2)}));
    EXPECT_EQ(biases_with_at_most(curve, {0, 1}), (BiasInterval{3, previous_bias(5)}));
    EXPECT_EQ(biases_with_at_most(curve, {0, 0}), std::nullopt);
    EXPECT_EQ(biases_with_at_most(curve, {2, 2}), every_bias);
}

TEST(ParetoFront, KeepsWhatNothingImproves)
{
    const auto front = pareto_front(
        CurveImages{{{lit, 0.125F}, {blocked, 0.25F}, {lit, 0.5F}, {lit, 0.75F}, {blocked, 1.0F}}}
            .curve(),
        100);
    EXPECT_THAT(front, ElementsAre(CurvePoint{0.125F, {2, 0}}, CurvePoint{0.75F, {0, 1}}));
}

TEST(ParetoFront, HasEveryNondominatedPairOnce)
{
    std::mt19937 random{6};
    for (int i = 0; i < 1000; ++i) {
        const auto pixels = random_pixels(random);
        const auto front = pareto_front(CurveImages{pixels}.curve(), 1000);
        for (std::size_t k = 0; k < front.size(); ++k) {
            ASSERT_EQ(count_errors(pixels, front[k].bias), front[k].errors) << "case " << i;
            if (k > 0) {
                ASSERT_LT(front[k - 1].bias, front[k].bias) << "case " << i;
                ASSERT_GT(front[k - 1].errors.false_shadow, front[k].errors.false_shadow);
                ASSERT_LT(front[k - 1].errors.false_lit, front[k].errors.false_lit);
            }
        }
        for (const float bias : telling_biases(pixels)) {
            const ErrorCounts errors = count_errors(pixels, bias);
            ASSERT_TRUE(std::any_of(front.begin(), front.end(),
                                    [&](const CurvePoint& point) {
                                        return point.errors.false_shadow <= errors.false_shadow &&
                                               point.errors.false_lit <= errors.false_lit;
                                    }))
                << "case " << i << " at " << bias;
        }
    }
}

/// Alternates lit and blocked pixels at 1, 2, 3, … millionths, so that every bias is on the front.
CurveImages alternating(int count)
{
    std::vector<CurvePixel> pixels;
    for (int i = 1; i <= count; ++i) {
        pixels.push_back({i % 2 == 0 ? lit : blocked, static_cast<float>(i) * 1e-6F});
    }
    return CurveImages{pixels};
}

TEST(ParetoFront, IsThinnedBetweenItsExtremes)
{
    const BiasCurve curve = alternating(1000).curve();
    const auto all = pareto_front(curve, 1000);
    const auto few = pareto_front(curve, 10);
    ASSERT_EQ(all.size(), 501U);
    ASSERT_EQ(few.size(), 10U);
    EXPECT_EQ(few.front(), all.front());
    EXPECT_EQ(few.back(), all.back());
    EXPECT_THROW((void)pareto_front(curve, 1), std::invalid_argument);
}

TEST(SampleBiases, HoldsEveryStepOfAShortCurve)
{
    EXPECT_THAT(sample_biases(CurveImages{{{lit, 0.25F}, {blocked, 0.5F}}}.curve()),
                ElementsAre(0.0F, previous_bias(0.25F), 0.25F, 0.5F));
    EXPECT_EQ(sample_biases(CurveImages{{{lit, infinity}}}.curve()).size(), 1U);
}

TEST(SampleBiases, ReachesOverALongCurveInFewPoints)
{
    const BiasCurve curve = alternating(100'000).curve();
    const auto biases = sample_biases(curve, 200);
    EXPECT_LE(biases.size(), 200U);
    EXPECT_GE(biases.size(), 190U);
    EXPECT_EQ(biases.front(), 0.0F);
    EXPECT_EQ(biases.back(), curve.lit().back());
    for (std::size_t k = 1; k < biases.size(); ++k) {
        // 99 quantiles: at most 1/98 of the pixels change between neighbours, rounded up.
        const auto& [before, after] = std::pair{curve.at(biases[k - 1]), curve.at(biases[k])};
        EXPECT_LE(before.false_shadow - after.false_shadow + after.false_lit - before.false_lit,
                  100'000U / 98 + 1);
    }
    EXPECT_THROW((void)sample_biases(curve, 7), std::invalid_argument);
}

} // namespace
} // namespace gnomon::analysis
