#include "finding_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> ranked_keys(const analysis::Comparison& comparison)
{
    std::vector<std::string> keys;
    for (const analysis::Remedy& remedy : analysis::ranked_remedies(comparison)) {
        keys.push_back(remedy.keys.front());
    }
    return keys;
}

TEST(Remedies, RankTheCheapestThatCuresMostBeforeTheBest)
{
    analysis::Comparison comparison = comparison_of(60, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.advice = {rerun("large", {0, 0}), rerun("most", {10, 0}), rerun("little", {55, 0}),
                         rerun("taps", {2, 0}), rerun("worse", {61, 0})};
    comparison.advice[0].cost.map_bytes = 100;
    comparison.advice[1].cost.map_bytes = 50;
    comparison.advice[2].cost.map_bytes = 10;
    comparison.advice[3].cost.map_bytes = 50;
    comparison.advice[3].cost.taps = 9;
    EXPECT_THAT(ranked_keys(comparison), ElementsAre("most", "taps", "large", "little"));
}

TEST(Remedies, KeepAtLeastHalfOfTheShadows)
{
    analysis::Comparison comparison = comparison_of(100, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.advice = {rerun("half", {0, 50}), rerun("most", {0, 51})};
    EXPECT_THAT(ranked_keys(comparison), ElementsAre("half"));
    // Other views may lose shadows that the job's own keeps.
    analysis::ViewOutcome own;
    own.metrics = make_metrics(comparison.metrics.pixels, {0, 50, {0, 50, 0, 0}});
    analysis::ViewOutcome other;
    other.metrics = make_metrics(comparison.metrics.pixels, {0, 51, {0, 51, 0, 0}});
    comparison.advice[0].views = {own, other};
    EXPECT_THAT(ranked_keys(comparison), IsEmpty());
}

TEST(Remedies, ThatAddNothingAreNotListed)
{
    analysis::Comparison comparison = comparison_of(1000, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.advice = {rerun("a", {100, 0}), rerun("a", {96, 0}), rerun("b", {996, 0}),
                         rerun("a", {94, 0})};
    comparison.advice[1].keys.emplace_back("c");
    comparison.advice[3].keys.emplace_back("d");
    std::vector<std::size_t> counts;
    for (const analysis::Remedy& remedy : analysis::ranked_remedies(comparison)) {
        counts.push_back(remedy.outcome.errors.total());
    }
    EXPECT_THAT(counts, ElementsAre(94, 100)) << "5 of 1,000 px are the least that is told";
}

TEST(Remedies, MendABiasThatIsSetBeforeTheyAddOne)
{
    analysis::Comparison comparison = comparison_of(60, 0);
    set_causes(comparison, analysis::Cause::bias, analysis::Label::overshadow);
    comparison.advice = {rerun("another", {1, 0}), rerun("none", {6, 0}), rerun("half", {30, 0})};
    comparison.advice.push_back(rerun("none, shorter", {5, 0}));
    comparison.advice[1].bias_change = comparison.advice[2].bias_change =
        analysis::BiasChange::mends;
    comparison.advice[3].bias_change = analysis::BiasChange::mends_and_shortens;
    EXPECT_THAT(ranked_keys(comparison), ElementsAre("none", "none, shorter", "another", "half"))
        << "before those that cure as good as all, not before better ones";
}

TEST(Remedies, ThatWorsenCountsOrAmountsComeLast)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {10, 0, {40, 0, 60, 0}});
    comparison.advice = {rerun("more wrong", {11, 0}), rerun("more softened", {5, 0}),
                         rerun("less", {9, 0})};
    comparison.advice[0].outcome.amounts = {1, 0, 0, 0};
    comparison.advice[1].outcome.amounts = {41, 0, 0, 0};
    comparison.advice[1].outcome.softening = 39;
    comparison.advice[1].outcome.left_out = 39;
    comparison.advice[2].outcome.amounts = {30, 0, 0, 0};
    EXPECT_THAT(ranked_keys(comparison), ElementsAre("less", "more wrong", "more softened"));
    EXPECT_THAT(analysis::trade_offs(comparison), IsEmpty());
    comparison.advice.pop_back();
    EXPECT_THAT(ranked_keys(comparison), IsEmpty()) << "none of them is first";
    EXPECT_EQ(analysis::trade_offs(comparison).front().keys.front(), "more wrong");
}

TEST(Remedies, AreWhatCurvesHoldAndOnceEach)
{
    analysis::Comparison comparison = comparison_of(60, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.diagnosis->curve.recommended = recommended(0.375F, 20);
    comparison.advice = {rerun("bias.constant = 0.375", {20, 0})};
    analysis::SlopeAnswer& better = comparison.diagnosis->biases->slopes.emplace_back();
    better.slope = 0.5F;
    better.recommended = recommended(0.125F, 5);
    analysis::SlopeAnswer& no_better = comparison.diagnosis->biases->slopes.emplace_back();
    no_better.slope = 0.25F;
    no_better.recommended = recommended(0.25F, 20);
    const auto ranked = analysis::ranked_remedies(comparison);
    ASSERT_EQ(ranked.size(), 2U);
    EXPECT_THAT(ranked[0].keys, ElementsAre("bias.slope = 0.5", "bias.constant = 0.125"));
    EXPECT_EQ(ranked[0].measured_by, analysis::MeasuredBy::slope_curve);
    EXPECT_EQ(ranked[1].measured_by, analysis::MeasuredBy::rerun) << "GL goes before the curve";
}

} // namespace
} // namespace gnomon::reports
