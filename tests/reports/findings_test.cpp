#include "reports/findings.hpp"

#include "reports/tune_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::reports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// 100 lit and 100 blocked pixels; a lit pixel needs a bias of 0.25, the blocked allow 0.5.
analysis::Comparison comparison_of(std::uint64_t false_shadow, std::uint64_t false_lit)
{
    analysis::Comparison comparison;
    analysis::Metrics& metrics = comparison.metrics;
    metrics.pixels.by_class[static_cast<std::size_t>(scene::PixelClass::lit)] = 100;
    metrics.pixels.by_class[static_cast<std::size_t>(scene::PixelClass::blocked)] = 100;
    metrics =
        make_metrics(metrics.pixels,
                     {false_shadow,
                      false_lit,
                      {static_cast<double>(false_shadow), static_cast<double>(false_lit), 0, 0}});

    scene::Image<float> critical{{200, 1}, -0.5F};
    scene::Image<scene::PixelClass> classes{{200, 1}, scene::PixelClass::lit};
    for (int i = 100; i < 200; ++i) {
        classes(i, 0) = scene::PixelClass::blocked;
        critical(i, 0) = 0.5F;
    }
    critical[0] = 0.25F;
    analysis::BiasCurve curve{critical, classes};
    const analysis::BestBiases best = find_best_biases(curve);
    const analysis::PixelCauses acne{
        scene::Image<analysis::PixelCause>{
            {200, 1}, {analysis::Cause::resolution, analysis::Cause::resolution, true}},
        {}};
    const auto acne_free = [&](std::span<const std::uint64_t> allowed) {
        return analysis::find_acne_free({classes, critical, acne}, allowed);
    };
    const analysis::BiasBounds bounds = find_bias_bounds(curve, critical, classes, acne_free, {});
    comparison.diagnosis = analysis::Diagnosis{
        .causes = {},
        .peter_panning = {},
        .biases = analysis::BiasAnswers{critical, std::move(curve), best, bounds, {}, {}, 0},
        .by_distance = {},
        .by_angle = {},
        .by_object = {}};
    return comparison;
}

void set_causes(analysis::Comparison& comparison, analysis::Cause cause, analysis::Label label)
{
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    counts.by_cause[static_cast<std::size_t>(cause)] = wrong;
    counts.by_label[static_cast<std::size_t>(label)] = wrong;
}

TEST(Findings, AreSilentWithoutADiagnosis)
{
    EXPECT_THAT(findings(analysis::Comparison{}), IsEmpty());
}

TEST(Findings, SayThatAllIsRight)
{
    EXPECT_THAT(findings(comparison_of(0, 0)), ElementsAre("All 200 scored pixels are right."));
}

TEST(Findings, DoNotCallRightWhatIsWrongByLessThanHalf)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {0, 0, {39.8, 0, 100, 0}});
    EXPECT_THAT(
        findings(comparison),
        ElementsAre("No scored pixel is wrong by more than one half, yet verdicts are off by "
                    "19.9 % on average: 100 of 200 pixels are partly wrong, by 39.8 pixels "
                    "of false shadow and 0 of false light in all.",
                    "Against acne the constant bias should be at least 0.25 (for at most 0.1 % of "
                    "the pixels, by amount); it is 0."));
}

TEST(Findings, SayWhatMostOfTheAmountIs)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {0, 0, {40, 0, 100, 0}});
    analysis::CauseAmounts& amounts = comparison.diagnosis->causes.amounts;
    amounts.by_label[static_cast<std::size_t>(analysis::Label::acne)] = 10;
    amounts.by_label[static_cast<std::size_t>(analysis::Label::edge)] = 30;
    amounts.shadow_softening = 25;
    EXPECT_THAT(findings(comparison)[0],
                testing::EndsWith(" Of the amount, 25 % is acne, and 62 % is borders that the "
                                  "kernel softens on purpose."));
}

TEST(Findings, AddTheAmountToTheCounts)
{
    analysis::Comparison comparison = comparison_of(20, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {20, 0, {50, 0, 80, 0}});
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    EXPECT_THAT(findings(comparison).front(),
                HasSubstr(" By amount verdicts are off by 25.0 % on average."));
}

TEST(Findings, NameWhatAcneNeedsAndWhatTheBestBiasGives)
{
    analysis::Comparison comparison = comparison_of(1, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    const auto sentences = findings(comparison);
    ASSERT_EQ(sentences.size(), 3U);
    EXPECT_THAT(sentences[0], HasSubstr("100 % of the errors are acne, and 100 % are due to the "
                                        "map's resolution"));
    EXPECT_THAT(sentences[1], HasSubstr("at least 0.25"));
    EXPECT_THAT(sentences[2], HasSubstr("bias.constant = 0.375 has the fewest errors: 0 in place "
                                        "of 1"));
}

TEST(Findings, SetTheBiasAgainstWhatPanningAllows)
{
    analysis::Comparison comparison = comparison_of(0, 100);
    set_causes(comparison, analysis::Cause::bias, analysis::Label::peter_panning);
    comparison.view.bias.constant = 0.75F;
    comparison.view.bias.slope = 0.125F;
    const auto sentences = findings(comparison);
    ASSERT_EQ(sentences.size(), 3U);
    EXPECT_THAT(sentences[1], HasSubstr("is 1.5 times what peter-panning allows here (0.5"));
    EXPECT_THAT(sentences[2], HasSubstr("has the fewest errors: 0 in place of 100"));
    EXPECT_THAT(errors_in_words(comparison)[1], HasSubstr("a slope bias of 0.125 as well"));
}

TEST(Findings, SayThatNoConstantBiasServesWhateverTheJobs)
{
    for (const float bias : {0.0F, 0.3F, 0.75F}) {
        analysis::Comparison comparison = comparison_of(50, 50);
        set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
        comparison.view.bias.constant = bias;
        analysis::BiasBounds& bounds = comparison.diagnosis->biases->bounds;
        bounds.no_constant_bias_serves = true;
        bounds.allowances[1].acne_free = 0.25F;
        bounds.allowances[1].panning_free = 0.125F;
        const auto sentences = findings(comparison);
        ASSERT_GE(sentences.size(), 2U);
        EXPECT_EQ(sentences[1], "No constant bias keeps both kinds of errors below 0.1 %: acne "
                                "needs at least 0.25, and false light allows at most 0.125.");
    }
}

TEST(Findings, NameTheBestOfTheMeasuredChangesAndPromiseNoOther)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.diagnosis->biases.reset();
    const auto without = findings(comparison);
    ASSERT_EQ(without.size(), 2U);
    EXPECT_THAT(without[1], HasSubstr("--advise measures it"));
    comparison.advice = {
        {{"shadow_map.resolution = 2048"}, {9, 0}, 0.045, {9, 0, 0, 0}},
        {{"shadow_map.cull = \"none\"", "bias.constant = 0.5"}, {2, 1}, 0.015, {2, 1, 0, 0}}};
    const auto with = findings(comparison);
    ASSERT_EQ(with.size(), 2U);
    EXPECT_EQ(with[1], "Of 2 changes measured, shadow_map.cull = \"none\", bias.constant = 0.5 "
                       "has the fewest errors: 3 in place of 10.");
    comparison.advice.pop_back();
    comparison.advice[0].errors = {11, 0};
    EXPECT_EQ(findings(comparison)[1], "Of 1 change measured, none has fewer errors.");
}

TEST(Findings, ChooseByAmountWhereVerdictsAreFractions)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    set_causes(comparison, analysis::Cause::filter, analysis::Label::edge);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {10, 0, {30, 0, 40, 0}});
    comparison.diagnosis->causes.amounts.shadow_softening = 12;
    comparison.advice = {{{"bias.constant = 0.5"}, {1, 0}, 0.005, {20, 8, 30, 0}, 14},
                         {{"bias.constant = 0.25"}, {4, 0}, 0.02, {20, 0, 30, 0}, 13}};
    EXPECT_THAT(
        findings(comparison),
        testing::Contains("Of 2 changes measured, bias.constant = 0.25 is the least wrong "
                          "by amount: 7.00 px in place of 18.0, without softened borders."));
    comparison.advice.clear();
    for (const auto& [bias, amount] : {std::pair{-0.5F, 1.0}, {0.125F, 25.0}, {0.5F, 28.0}}) {
        analysis::CurveSample sample{bias, {}};
        sample.counts.shadow_amount = amount;
        comparison.diagnosis->curve.points.push_back(sample);
    }
    EXPECT_THAT(
        findings(comparison),
        testing::Contains("With slope and offset as they are, bias.constant = 0.125 is the "
                          "least wrong by amount: 25.0 px in place of 30.0, softened borders "
                          "included."));
}

TEST(ErrorsInWords, RecommendNoOtherBias)
{
    analysis::Comparison comparison = comparison_of(1, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    for (const std::string& sentence : errors_in_words(comparison)) {
        EXPECT_THAT(sentence, Not(HasSubstr("bias.constant")));
    }
}

TEST(TuneToml, ReadsBackToTheSameBits)
{
    analysis::TunedSetting setting;
    setting.map.resolution_texels = 2048;
    setting.map.depth_format = {scene::DepthFormat::Kind::d16, 16};
    setting.map.frustum.near_m = 0.5;
    setting.constant = 0.0009866967F;
    setting.slope = 8.264e-05;
    EXPECT_EQ(tune_toml(setting), "[shadow_map]\n"
                                  "resolution = 2048\n"
                                  "depth_format = \"d16\"\n"
                                  "near = 0.5\n"
                                  "far = \"auto\"\n"
                                  "[bias]\n"
                                  "constant = 0.0009866967\n"
                                  "slope = 8.264e-05\n"
                                  "normal_texels = 0\n");
}

} // namespace
} // namespace gnomon::reports
