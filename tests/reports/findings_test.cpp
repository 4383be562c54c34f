#include "reports/text/findings.hpp"

#include "finding_case.hpp"
#include "reports/text/error_text.hpp"
#include "reports/tune/tune_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::reports {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Findings, AreSilentWithoutADiagnosis)
{
    EXPECT_THAT(findings(analysis::Comparison{}), IsEmpty());
}

TEST(Findings, SayThatAllIsRight)
{
    EXPECT_THAT(findings(comparison_of(0, 0)), ElementsAre("All 200 scored pixels are right."));
}

TEST(ErrorHeadline, IsTheMostFrequentErrorWithoutAFullStop)
{
    EXPECT_EQ(error_headline(comparison_of(0, 0)), "All 200 scored pixels are right");
    analysis::Comparison comparison = comparison_of(10, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    EXPECT_EQ(error_headline(comparison), "10.0 % of the lit surface shadows itself (acne)");
}

TEST(Findings, SayFirstThatTheLightIsInsideAnObject)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.light_shells = {"bulb", "lamp \"A\""};
    comparison.job.scene.no_cast = {"glass"};
    EXPECT_THAT(findings(comparison),
                ElementsAre("Only 100 of 200 scored pixels are lit: the light is inside \"bulb\", "
                            "\"lamp \\\"A\\\"\". If that is part of the lamp, set scene.no_cast = "
                            "[\"glass\", \"bulb\", \"lamp \\\"A\\\"\"]. All 200 scored pixels are "
                            "right."));
}

/// A comparison without scored pixels: 60 of background, and the given number of other classes.
analysis::Comparison
unscored(const std::vector<std::pair<scene::PixelClass, std::uint64_t>>& counts)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    analysis::ClassCounts pixels;
    pixels.total = 60;
    pixels.by_class[static_cast<std::size_t>(scene::PixelClass::background)] = 60;
    for (const auto& [pixel_class, count] : counts) {
        pixels.total += count;
        pixels.by_class[static_cast<std::size_t>(pixel_class)] = count;
    }
    comparison.metrics = make_metrics(pixels, {});
    return comparison;
}

TEST(Findings, SayWhyNoPixelIsScored)
{
    using scene::PixelClass;
    EXPECT_THAT(
        findings(unscored({{PixelClass::attached, 40}})),
        ElementsAre("No pixel is scored: all of the surface that the camera sees faces away "
                    "from the light."));
    EXPECT_THAT(
        findings(unscored({{PixelClass::out_of_light, 40}})),
        ElementsAre("No pixel is scored: all of the surface that the camera sees is outside "
                    "the light's cone."));
    EXPECT_THAT(findings(unscored({{PixelClass::attached, 10}, {PixelClass::out_of_light, 30}})),
                ElementsAre("No pixel is scored: 25.0 % of the surface that the camera sees faces "
                            "away from the light, 75.0 % is outside the light's cone."));
}

TEST(Findings, SayWhyNothingIsSeen)
{
    analysis::Comparison comparison = unscored({});
    scene::TriangleScene scene;
    scene.objects.resize(2);
    scene.objects[0].receives = false;
    comparison.triangles = &scene;
    EXPECT_THAT(findings(comparison), ElementsAre("No pixel is scored: the camera sees only "
                                                  "background; point it at the scene."));
    scene.objects[1].receives = false;
    EXPECT_THAT(findings(comparison), ElementsAre("No pixel is scored: every object is in "
                                                  "scene.no_receive, so none is drawn."));
}

TEST(Findings, CallBordersThatAKernelSoftensRight)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {0, 0, {20, 0, 100, 0}});
    analysis::CauseAmounts& amounts = comparison.diagnosis->causes.amounts;
    set_amounts(amounts, analysis::Cause::filter, analysis::Label::edge, 20);
    amounts.shadow_softening = 20;
    EXPECT_THAT(findings(comparison),
                ElementsAre("All 200 scored pixels are right but for borders that the kernel "
                            "softens on purpose: verdicts are off by 10.0 % on average."));
}

TEST(Findings, DoNotCallRightWhatIsWrongByLessThanHalf)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {0, 0, {60, 0, 100, 0}});
    analysis::CauseAmounts& amounts = comparison.diagnosis->causes.amounts;
    set_amounts(amounts, analysis::Cause::resolution, analysis::Label::acne, 40);
    set_amounts(amounts, analysis::Cause::filter, analysis::Label::edge, 20);
    amounts.shadow_softening = 20;
    const auto sentences = findings(comparison);
    EXPECT_EQ(sentences.front(),
              "By amount, 40.0 % of the lit surface shadows itself (acne). Borders that the kernel "
              "softens on purpose are left out of this; they are 10.0 % of the surface.");
    EXPECT_EQ(sentences.back(), "`--advise` measures what cures the errors.");
}

TEST(Findings, TellTheRemedyBeforeTheCause)
{
    analysis::Comparison comparison = comparison_of(20, 4);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.diagnosis->curve.recommended = recommended(0.375F, 1);
    comparison.diagnosis->left_by_recommended = left({{analysis::Label::acne, 1}});
    EXPECT_THAT(findings(comparison),
                ElementsAre("24.0 % of the lit surface shadows itself (acne).",
                            "bias.constant = 0.375 (1.5 m, 3 texels) leaves 0.500 % of the surface "
                            "wrong, in place of 12.0 %.",
                            "100 % of the error is acne, which this bias cures."));
}

/// 60 px of acne and 40 px of ragged edges. Infinitely fine texels would repair both; a bias
/// leaves the edges.
analysis::Comparison acne_and_edges()
{
    analysis::Comparison comparison = comparison_of(80, 20);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::edge);
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    counts.by_label[static_cast<std::size_t>(analysis::Label::acne)] = 63;
    counts.by_label[static_cast<std::size_t>(analysis::Label::edge)] = 37;
    comparison.diagnosis->curve.recommended = recommended(0.375F, 37);
    comparison.diagnosis->left_by_recommended = left({{analysis::Label::edge, 37}});
    return comparison;
}

analysis::Cure finer_texels(double shadow, const analysis::NamedErrors& by_name)
{
    return {analysis::Cause::resolution,
            {"shadow_map.resolution = 4096"},
            100,
            {{static_cast<std::uint64_t>(shadow), 0}, {shadow, 0, 0, 0}, 0},
            analysis::MeasuredBy::rerun,
            by_name};
}

TEST(Findings, NameNoCauseWhoseCureWasNotMeasured)
{
    const auto sentences = findings(acne_and_edges());
    EXPECT_EQ(sentences[2], "63 % of the error is acne, which this bias cures; 37 % is ragged "
                            "edges, which this bias leaves.");
}

TEST(Findings, SayWhatABiasCuresInPart)
{
    analysis::Comparison comparison = acne_and_edges();
    comparison.diagnosis->left_by_recommended = left({{analysis::Label::edge, 30}}); // of 37
    EXPECT_EQ(findings(comparison)[2], "63 % of the error is acne, which this bias cures; 37 % is "
                                       "ragged edges, which this bias cures in part.");
}

TEST(Findings, NameTheOtherBiasThatMayBeAtFault)
{
    analysis::Comparison comparison = acne_and_edges();
    comparison.view.bias.normal_texels = 2;
    const std::string fault = "The job also sets a normal offset of 2 texels, which may be at "
                              "fault: `--advise` measures what is left without it.";
    EXPECT_THAT(findings(comparison), Not(testing::Contains(fault)));
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    counts.by_cause[static_cast<std::size_t>(analysis::Cause::bias)] = 40;
    counts.by_cause[static_cast<std::size_t>(analysis::Cause::resolution)] = 60;
    EXPECT_EQ(findings(comparison)[2], fault);
    comparison.advice = {rerun("bias.normal_texels = 0", {11, 0})};
    EXPECT_THAT(findings(comparison), Not(testing::Contains(fault)));
}

TEST(Findings, TellCauseAndCureInOneSentence)
{
    analysis::Comparison comparison = acne_and_edges();
    comparison.cures = {
        finer_texels(20, left({{analysis::Label::acne, 12}, {analysis::Label::edge, 8}}))};
    EXPECT_EQ(findings(comparison)[2],
              "63 % of the error is acne, which this bias cures, as finer texels would; 37 % is "
              "ragged edges, which only finer texels cure.");
}

TEST(Findings, CallNothingACureThatLeavesMoreThanHalf)
{
    analysis::Comparison comparison = acne_and_edges();
    // It cures half of its 100 px, so it is named; it leaves 43 px of the acne.
    comparison.cures = {
        finer_texels(50, left({{analysis::Label::acne, 43}, {analysis::Label::edge, 7}}))};
    EXPECT_THAT(findings(comparison)[2],
                testing::EndsWith("acne, which this bias cures; 37 % is ragged edges, which only "
                                  "finer texels cure."));
    comparison.cures = {
        finer_texels(51, left({{analysis::Label::acne, 44}, {analysis::Label::edge, 7}}))};
    EXPECT_THAT(findings(comparison)[2], Not(HasSubstr("texels")));
}

TEST(Findings, NameTheCauseThatTheRemedyActsOn)
{
    analysis::Comparison comparison = comparison_of(40, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::edge);
    comparison.advice = {rerun("shadow_map.resolution = 2048", {20, 0})};
    EXPECT_EQ(findings(comparison).size(), 2U) << "its cure is not known";
    comparison.cures = {finer_texels(5, left({{analysis::Label::edge, 5}}))};
    comparison.cures[0].laid = 40;
    ASSERT_EQ(findings(comparison).size(), 3U);
    EXPECT_THAT(findings(comparison)[2],
                testing::EndsWith("100 % of the error is due to the map's resolution."));
}

TEST(Findings, NameEachKindThatIsAQuarterOfTheError)
{
    analysis::Comparison comparison = comparison_of(30, 30);
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    counts.by_label[static_cast<std::size_t>(analysis::Label::acne)] = 30;
    counts.by_label[static_cast<std::size_t>(analysis::Label::peter_panning)] = 20;
    counts.by_label[static_cast<std::size_t>(analysis::Label::leak)] = 10;
    EXPECT_EQ(findings(comparison).front(),
              "30.0 % of the lit surface shadows itself (acne), and 20.0 % of the shadowed surface "
              "is lit because the bias detaches shadows (peter-panning).");
}

TEST(Findings, SayWhatARemedyCosts)
{
    analysis::Comparison comparison = comparison_of(0, 40);
    set_causes(comparison, analysis::Cause::precision, analysis::Label::leak);
    analysis::Remedy finer = rerun("shadow_map.resolution = 2048", {0, 20});
    finer.cost.map_bytes = std::uint64_t{2048} * 2048 * 4;
    finer.step = {0.34, 0.0012};
    comparison.advice = {finer};
    EXPECT_EQ(findings(comparison)[1],
              "shadow_map.resolution = 2048 leaves 10.0 % of the surface wrong, in place of "
              "20.0 %, with a map of 16 MiB; a step of the stored depth is then 0.0012 m at the "
              "median receiver, in place of 0.34 m.");
}

TEST(Findings, SayWhatARemedyDoesToCountsAndToAmounts)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {10, 0, {40, 0, 60, 0}});
    analysis::CauseAmounts& amounts = comparison.diagnosis->causes.amounts;
    set_amounts(amounts, analysis::Cause::resolution, analysis::Label::acne, 40);
    comparison.advice = {rerun("bias.constant = 0.5", {4, 0})};
    comparison.advice[0].outcome.amounts = {20, 4, 0, 0};
    comparison.advice[0].outcome.softening = 12;
    comparison.advice[0].outcome.left_out = 12;
    EXPECT_EQ(
        findings(comparison)[1],
        "bias.constant = 0.5 leaves an amount of error of 6.00 % without softened borders, in "
        "place of 20.0 %, and 4 wrong pixels in place of 10.");
    comparison.advice[0].outcome.errors = {12, 0};
    EXPECT_EQ(findings(comparison)[1],
              "No known change lessens wrong pixels and amounts alike. bias.constant = 0.5 leaves "
              "an amount of error of 6.00 % without softened borders, in place of 20.0 %; but 12 "
              "wrong pixels in place of 10.");
}

TEST(Findings, NameTheCascadesThatNoPixelReads)
{
    analysis::Comparison comparison = comparison_of(20, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.view.maps.resize(2);
    comparison.view.slices.begin = 0.5F;
    comparison.view.slices.ends = {2, 8};
    comparison.diagnosis->by_map.resize(2);
    comparison.diagnosis->by_map[1].counts = {100, 100, 20, 0, 20, 0};
    EXPECT_EQ(findings(comparison).back(), "No scored pixel reads cascade 0, from 0.5 to 2 m.");
}

TEST(Findings, SayOnHowManyViewsARemedyHolds)
{
    analysis::Comparison comparison = comparison_of(40, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    analysis::Remedy remedy = rerun("bias.constant = 0.5", {2, 0});
    for (const std::uint64_t wrong : {2U, 5U, 3U}) {
        analysis::ViewOutcome view;
        view.metrics = make_metrics(comparison.metrics.pixels,
                                    {wrong, 0, {static_cast<double>(wrong), 0, 0, 0}});
        remedy.views.push_back(view);
    }
    comparison.advice = {remedy};
    for (const char* const name : {"own", "camera 1", "camera 2"}) {
        comparison.advice_views.views.push_back({name, {}, {}, {}});
    }
    EXPECT_THAT(findings(comparison)[1],
                testing::EndsWith(". Over 3 views it leaves at most 2.50 % (camera 1)."));
}

TEST(Findings, SayThatNoConstantBiasServesWhateverTheJobs)
{
    for (const float bias : {0.0F, 0.3F, 0.75F}) {
        analysis::Comparison comparison = comparison_of(50, 50);
        set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
        comparison.view.bias.constant = bias;
        analysis::BiasBounds& bounds = comparison.diagnosis->biases->bounds;
        bounds.no_constant_bias_serves = true;
        bounds.allowances[1].acne_free_count = 0.25F;
        bounds.allowances[1].panning_free = 0.125F;
        EXPECT_EQ(findings(comparison).back(),
                  "No constant bias keeps both kinds of errors below 0.1 %: acne needs at least "
                  "0.25, and false light allows at most 0.125.");
    }
}

TEST(Findings, OfferToMeasureChangesOnlyOfOwnMaps)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    comparison.metrics = make_metrics(comparison.metrics.pixels, {10, 0, {40, 0, 60, 0}});
    set_amounts(comparison.diagnosis->causes.amounts, analysis::Cause::resolution,
                analysis::Label::acne, 40);
    comparison.diagnosis->curve.recommended = recommended(0.5F, 12);
    comparison.diagnosis->curve.recommended->rounded_outcome = {{12, 0}, {20, 4, 0, 0}, 12, 12};
    EXPECT_THAT(findings(comparison)[1],
                testing::StartsWith("No bias lessens wrong pixels and amounts alike; `--advise` "
                                    "measures other changes. bias.constant = 0.5 "));
    comparison.evaluation.emplace();
    EXPECT_THAT(findings(comparison)[1],
                testing::StartsWith("No known change lessens wrong pixels and amounts alike. "));
}

TEST(Findings, PromiseNothingThatWasNotMeasured)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    EXPECT_THAT(findings(comparison)[1], HasSubstr("`--advise` measures what cures the errors"));
    comparison.advice = {rerun("shadow_map.cull = \"none\"", {11, 0})};
    EXPECT_EQ(findings(comparison)[1], "None of 1 measured change leaves less.");
}

TEST(ErrorsInWords, RecommendNoOtherBias)
{
    analysis::Comparison comparison = comparison_of(1, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    for (const std::string& sentence : errors_as_text(comparison)) {
        EXPECT_THAT(sentence, Not(HasSubstr("bias.constant")));
    }
}

TEST(TuneToml, ReadsBackToTheSameBits)
{
    analysis::TunedSetting setting;
    setting.map.resolution_texels = 2048;
    setting.map.depth_format = {scene::DepthFormat::Kind::d16, 16};
    setting.map.frustum.near_m = 0.5;
    setting.bias.rounded = {"bias.constant = 0.0009866967", 0.0009866967F};
    setting.slope = 8.264e-05;
    EXPECT_EQ(tune_toml(setting, scene::Fit::scene), "[shadow_map]\n"
                                                     "resolution = 2048\n"
                                                     "depth_format = \"d16\"\n"
                                                     "fit = \"scene\"\n"
                                                     "near = 0.5\n"
                                                     "far = \"auto\"\n"
                                                     "cull = \"none\"\n"
                                                     "[lookup]\n"
                                                     "filter = \"nearest\"\n"
                                                     "[bias]\n"
                                                     "constant = 0.0009866967\n"
                                                     "slope = 8.264e-05\n"
                                                     "normal_texels = 0\n");
    // The size of a fixed map is refused with another fit.
    EXPECT_THAT(tune_toml(setting, scene::Fit::fixed),
                HasSubstr("fit = \"scene\" # and remove half_extent or fov_deg\nnear"));
    setting.map.frustum.fit = scene::Fit::fixed;
    EXPECT_THAT(tune_toml(setting, scene::Fit::fixed), HasSubstr("fit = \"fixed\"\nnear"));
}

TEST(ChangedToml, HasATableALineWithWhatTheJobHasOtherwise)
{
    analysis::TuneResult result;
    scene::Job job;
    job.shadow_map.frustum.fit = scene::Fit::fixed;
    result.views.push_back({"own", job});
    analysis::TunedSetting best{job.shadow_map, job.lookup.filter, 0, 0, {}, {}, {}};
    best.map.resolution_texels = 2048;
    best.map.frustum.fit = scene::Fit::scene;
    best.bias.rounded = {"bias.constant = 0.002", 0.002F};
    result.considered.push_back(best);
    EXPECT_EQ(changed_toml({"", result}),
              "shadow_map = { resolution = 2048, fit = \"scene\" } # and remove half_extent or "
              "fov_deg\nbias = { constant = 0.002 }\n");
}

} // namespace
} // namespace gnomon::reports
