#include "reports/text/findings.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace gnomon::reports {
namespace {

using analysis::Margin;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

/// 4 m and 8 texels per depth unit.
analysis::BiasLength length(float bias)
{
    return {bias, 4.0 * double{bias}, 8.0 * double{bias}};
}

/// A recommendation that leaves this many pixels in shadow.
analysis::Recommendation recommendation_of(float bias, std::uint64_t left,
                                           Margin margin = Margin::whole)
{
    const analysis::Outcome outcome{{left, 0}, {static_cast<double>(left), 0, 0, 0}, 0};
    return {length(bias),
            length(bias / 2),
            length(4 * bias),
            outcome,
            {fmt::format("bias.constant = {}", bias), bias},
            length(bias),
            outcome,
            1,
            margin};
}

/// A camera 10 m from its target, with a picture 8 m high there: 5 % are 0.4 m.
analysis::Comparison comparison_with(const analysis::Recommendation& own)
{
    analysis::Comparison comparison;
    comparison.view.camera.half_height = 0.4;
    comparison.target_distance_m = 10;
    comparison.diagnosis.emplace();
    comparison.diagnosis->curve.recommended = own;
    return comparison;
}

/// Adds a bias curve for each slope, with its recommendation.
void add_slopes(analysis::Comparison& comparison,
                const std::vector<std::pair<float, analysis::Recommendation>>& slopes)
{
    analysis::BiasAnswers answers{
        {}, {scene::Image<float>{{0, 0}}, scene::Image<scene::PixelClass>{{0, 0}}}, {}, {}, {}, {},
        0};
    for (const auto& [slope, recommendation] : slopes) {
        answers.slopes.push_back({slope, {}, {}, recommendation});
    }
    comparison.diagnosis->biases = std::move(answers);
}

TEST(RecommendationSentences, SayWhatIsSparedAndWhatIsLost)
{
    EXPECT_THAT(
        recommendation_sentences(comparison_with(recommendation_of(0.0625F, 3))),
        ElementsAre("It is the smallest with three texels to spare; 0.03125 (0.125 m) to 0.25 (1 "
                    "m) are nearly as good here.",
                    "A caster whose lit side is nearer than 0.25 m to a surface, along the light's "
                    "axis, casts no shadow there."));
}

TEST(RecommendationSentences, SayWhereNothingLimitsTheBias)
{
    analysis::Recommendation own = recommendation_of(0.0625F, 3);
    own.high = {std::numeric_limits<float>::infinity(), 0, 0};
    EXPECT_THAT(recommendation_sentences(comparison_with(own)).front(),
                EndsWith("; all from 0.03125 (0.125 m) on are nearly as good here."));
    own.low = {};
    EXPECT_THAT(recommendation_sentences(comparison_with(own)).front(),
                EndsWith("; all others are nearly as good here."));
}

TEST(RecommendationSentences, DoNotPromiseThreeTexelsThatAreNotThere)
{
    EXPECT_THAT(
        recommendation_sentences(comparison_with(recommendation_of(0.0625F, 3, Margin::cut_short)))
            .front(),
        HasSubstr("with less than three texels to spare"));
    EXPECT_THAT(recommendation_sentences(
                    comparison_with(recommendation_of(0.0625F, 3, Margin::within_limits)))
                    .front(),
                HasSubstr("that meets the limits"));
}

TEST(RecommendationSentences, SayThatNoBiasIsNeeded)
{
    analysis::Recommendation own = recommendation_of(0, 3, Margin::not_needed);
    own.high = length(0.125F);
    EXPECT_THAT(recommendation_sentences(comparison_with(own)),
                ElementsAre("No constant bias is needed; all up to 0.125 (0.5 m) are nearly as "
                            "good here.",
                            "A constant bias of 0 takes no caster's shadow away."));
}

TEST(RecommendationSentences, AreMissingWhereNothingIsRecommended)
{
    analysis::Comparison comparison = comparison_with(recommendation_of(0.0625F, 3));
    comparison.diagnosis->curve.recommended.reset();
    EXPECT_THAT(recommendation_sentences(comparison), IsEmpty());
}

TEST(LongBias, IsMoreThanATwentiethOfThePicturesHeight)
{
    EXPECT_FALSE(long_bias(comparison_with(recommendation_of(0.0625F, 3)))) << "0.25 m of 8 m";
    EXPECT_EQ(long_bias(comparison_with(recommendation_of(0.125F, 3))),
              "The recommended constant bias of 0.5 m is long: 6.25 % of the picture's height at "
              "the camera's target.");
    EXPECT_THAT(recommendation_sentences(comparison_with(recommendation_of(0.125F, 3))).back(),
                HasSubstr("is long"));
}

TEST(LongBias, IsMeasuredAgainstAnOrthographicPictureWhereverItLooks)
{
    analysis::Comparison comparison = comparison_with(recommendation_of(0.125F, 3));
    comparison.view.camera.projection = scene::Projection::orthographic;
    comparison.view.camera.half_height = 2; // 0.5 m of 4 m
    comparison.target_distance_m = 0;
    EXPECT_TRUE(long_bias(comparison));
    comparison.view.camera.half_height = 20;
    EXPECT_FALSE(long_bias(comparison));
}

TEST(LongBias, IsNotToldOfAnUnknownPicture)
{
    analysis::Comparison comparison = comparison_with(recommendation_of(0.125F, 3));
    comparison.target_distance_m = 0;
    EXPECT_FALSE(long_bias(comparison));
}

TEST(LongBias, OffersTheSlopeWithTheSmallestConstantThatLeavesNoMore)
{
    analysis::Comparison comparison = comparison_with(recommendation_of(0.125F, 3));
    add_slopes(comparison, {{0.5F, recommendation_of(0.0625F, 3)},
                            {1, recommendation_of(0.03125F, 3)},
                            {2, recommendation_of(0.015625F, 4)},
                            {4, recommendation_of(0.25F, 0)}});
    EXPECT_THAT(*long_bias(comparison),
                EndsWith("; bias.slope = 1 with bias.constant = 0.03125 (0.125 m) leaves no more "
                         "error."));
}

TEST(LongBias, OffersNoSlopeForSeveralViews)
{
    analysis::Recommendation own = recommendation_of(0.125F, 3);
    own.views = 3;
    analysis::Comparison comparison = comparison_with(own);
    add_slopes(comparison, {{1, recommendation_of(0.03125F, 3)}});
    EXPECT_THAT(*long_bias(comparison), EndsWith("at the camera's target."));
}

} // namespace
} // namespace gnomon::reports
