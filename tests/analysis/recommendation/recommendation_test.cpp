#include "analysis/recommendation/recommendation.hpp"

#include "analysis/bias/bias_units.hpp"
#include "analysis/lookup/bias_order.hpp"
#include "analysis/recommendation/broad_minimum.hpp"
#include "scene/infinity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::infinity;
using scene::PixelClass;

scene::LightFrustum eight_metres()
{
    scene::LightFrustum frustum;
    frustum.near_m = 2;
    frustum.far_m = 10;
    return frustum;
}

TEST(RoundedBias, HasTwoDigitsWhereTheRunHoldsSuchABias)
{
    const RoundedBias rounded = rounded_bias(0.0074963F, {0.005F, 0.011F}, {}, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant = 0.0075");
    EXPECT_EQ(rounded.bias, 0.0075F);
}

TEST(RoundedBias, HasAsManyAsANarrowRunNeeds)
{
    const RoundedBias rounded = rounded_bias(0.23874F, {0.23872F, 0.238745F}, {}, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant = 0.23874");
    const float alone = 0.1F / 3;
    const RoundedBias exact = rounded_bias(alone, {alone, alone}, {}, eight_metres());
    EXPECT_EQ(exact.bias, alone);
    EXPECT_EQ(static_cast<float>(std::stod(exact.key.substr(exact.key.find('=') + 1))), alone);
}

TEST(RoundedBias, IsToldInMetresAsTheJobTells)
{
    scene::BiasSettings settings;
    settings.constant_m = 0.5;
    const RoundedBias rounded = rounded_bias(0.01234F, {0.01F, 0.02F}, settings, eight_metres());
    EXPECT_EQ(rounded.key, "bias.constant_m = 0.099");
    EXPECT_EQ(rounded.bias, static_cast<float>(0.099 / 8));
}

TEST(RoundedBias, OfZeroIsZero)
{
    EXPECT_EQ(rounded_bias(0, {0, 1}, {}, eight_metres()).key, "bias.constant = 0");
}

/// A map of 128 texels, each 1/64 m wide, over 8 m of depth: a texel is 1/512 of it.
BiasLengths under_a_sun()
{
    scene::LightFrustum frustum; // sides from -1 to 1
    frustum.near_m = 2;
    frustum.far_m = 10;
    return {frustum, 128, 5};
}

/// A spot whose median receiver is 5 m away, with 128 texels.
BiasLengths under_a_spot()
{
    BiasLengths lengths = under_a_sun();
    lengths.frustum.projection = scene::Projection::perspective;
    return lengths;
}

/// The critical biases of lit and blocked pixels, one pixel each.
BiasCurve curve_of(const std::vector<float>& lit, const std::vector<float>& blocked)
{
    const auto count = static_cast<int>(lit.size() + blocked.size());
    scene::Image<float> criticals{{count, 1}};
    scene::Image<PixelClass> classes{{count, 1}, PixelClass::lit};
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        const bool is_lit = i < lit.size();
        criticals[i] = is_lit ? lit[i] : blocked[i - lit.size()];
        classes[i] = is_lit ? PixelClass::lit : PixelClass::blocked;
    }
    return {criticals, classes};
}

TEST(RecommendedBias, IsThreeTexelsAboveTheLowerEnd)
{
    const RecommendedBias found = recommended_bias({0.125F, 0.5F}, under_a_sun());
    EXPECT_EQ(found.bias, 0.125F + 3.0F / 512) << "all of these are dyadic";
    EXPECT_EQ(found.margin, Margin::whole);
}

TEST(RecommendedBias, IsThreeTexelsLongerUnderASpot)
{
    const RecommendedBias found = recommended_bias({0.125F, 0.9F}, under_a_spot());
    // The bias is rounded to float32 once: a part in 2^24 of a length of about 40 texels.
    EXPECT_NEAR(under_a_spot().of(found.bias).texels, under_a_spot().of(0.125F).texels + 3, 1e-4);
}

TEST(RecommendedBias, IsAtMostTheGeometricMean)
{
    const RecommendedBias found = recommended_bias({0.001F, 0.0016F}, under_a_sun());
    EXPECT_EQ(found.bias, static_cast<float>(std::sqrt(double{0.001F} * double{0.0016F})));
    EXPECT_EQ(found.margin, Margin::cut_short);
}

TEST(RecommendedBias, NeedsNoMeanWhereNothingLimitsIt)
{
    EXPECT_EQ(recommended_bias({0.125F, infinity}, under_a_sun()).bias, 0.125F + 3.0F / 512);
}

TEST(RecommendedBias, IsZeroWhereTheValleyHoldsZero)
{
    const RecommendedBias found = recommended_bias({0, 0.5F}, under_a_sun());
    EXPECT_EQ(found.bias, 0);
    EXPECT_EQ(found.margin, Margin::not_needed);
}

TEST(RecommendedBias, IsAtMostOneWhereThreeTexelsReachTheLight)
{
    BiasLengths coarse = under_a_spot();
    coarse.resolution_texels = 2; // a texel is as wide as its distance from the light
    EXPECT_EQ(recommended_bias({0.125F, infinity}, coarse).bias, 1);
}

TEST(Recommended, IsNothingWhereNoScoredPixelIsLit)
{
    EXPECT_FALSE(recommend_by_count(curve_of({}, {0.5F}), under_a_sun(), {}));
}

TEST(Recommended, KeepsThreeQuartersOfItsMarginInFewDigits)
{
    const auto found = recommend_by_count(curve_of({0.149F}, {0.5F}), under_a_sun(), {});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->rounded.key, "bias.constant = 0.155") << "0.15 would leave half a texel";
}

/// Contact: moving a caster onto its receiver removes the upper limit of the broad minimum, but
/// keeps the lower end, which acne determines.
TEST(Recommended, DoesNotGrowWithTheGapThatCastersLeave)
{
    const auto with_gap_to = [](float gap) {
        return recommend_by_count(
            curve_of(std::vector<float>(100, 0.0625F), std::vector<float>(100, gap)), under_a_sun(),
            {});
    };
    const auto narrow = with_gap_to(0.125F);
    const auto wide = with_gap_to(0.9F);
    ASSERT_TRUE(narrow && wide);
    EXPECT_EQ(narrow->bias, wide->bias);
    EXPECT_EQ(wide->bias.depth, 0.0625F + 3.0F / 512);
}

/// The rule, literally, on curves of counts.
TEST(Recommended, IsWhatTheRuleSaysOnRandomCurves)
{
    std::mt19937 random{20261128};
    std::uniform_int_distribution<int> count{1, 12};
    std::uniform_real_distribution<float> exponent{-12, 0};
    const auto criticals = [&] {
        std::vector<float> all(static_cast<std::size_t>(count(random)));
        std::ranges::generate(all, [&] { return std::exp2(exponent(random)); });
        std::ranges::sort(all);
        return all;
    };
    for (int i = 0; i < 2000; ++i) {
        const std::vector<float> lit = criticals();
        const std::vector<float> blocked = criticals();
        const BiasLengths lengths = i % 2 == 0 ? under_a_sun() : under_a_spot();
        const auto found = recommend_by_count(curve_of(lit, blocked), lengths, {});
        ASSERT_TRUE(found) << i;
        const BiasInterval run = find_broad_minimum(error_pieces(lit, blocked))->run;
        EXPECT_EQ((BiasInterval{found->low.depth, found->high.depth}), run) << i;
        if (run.lo == 0) {
            EXPECT_EQ(found->bias.depth, 0) << i;
            continue;
        }
        const double mean = std::sqrt(double{run.lo} * double{run.hi});
        const double spared =
            bias_of_length(lengths.frustum,
                           lengths.of(run.lo).metres +
                               3 * lengths.frustum.texel_width_m(5, lengths.resolution_texels),
                           5);
        // Both are rounded to float32 once.
        EXPECT_FLOAT_EQ(found->bias.depth, static_cast<float>(std::min({spared, mean, 1.0}))) << i;
        EXPECT_TRUE(run.lo <= found->rounded.bias && found->rounded.bias <= run.hi) << i;
        EXPECT_GE(found->rounded.bias - run.lo, 0.74F * (found->bias.depth - run.lo)) << i;
    }
}

} // namespace
} // namespace gnomon::analysis
