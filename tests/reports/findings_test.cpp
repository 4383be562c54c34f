#include "reports/words/findings.hpp"

#include "analysis/advice/remedies.hpp"
#include "reports/tables/tune_report.hpp"

#include <fmt/format.h>
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
    comparison.view.maps.resize(1);
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
    comparison.job.shadow_map.resolution_texels = 1024;
    return comparison;
}

void set_causes(analysis::Comparison& comparison, analysis::Cause cause, analysis::Label label)
{
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    counts.by_cause[static_cast<std::size_t>(cause)] = wrong;
    counts.by_label[static_cast<std::size_t>(label)] = wrong;
}

void set_amounts(analysis::CauseAmounts& amounts, analysis::Cause cause, analysis::Label label,
                 double amount)
{
    amounts.by_cause[static_cast<std::size_t>(cause)] += amount;
    amounts.by_label[static_cast<std::size_t>(label)] += amount;
}

/// A recommendation that leaves so many pixels in shadow.
analysis::Recommendation recommended(float bias, std::uint64_t left)
{
    const analysis::BiasLength length{bias, 4.0 * double{bias}, 8.0 * double{bias}};
    const analysis::Outcome outcome{{left, 0}, {static_cast<double>(left), 0, 0, 0}, 0};
    return {length, length,  length, outcome, {fmt::format("bias.constant = {}", bias), bias},
            length, outcome, 1};
}

analysis::Remedy rerun(const std::string& key, const analysis::ErrorCounts& errors)
{
    return {
        {key},
        {errors,
         {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
         0},
        {},
        {std::uint64_t{1024} * 1024 * 4, 1}};
}

TEST(Findings, AreSilentWithoutADiagnosis)
{
    EXPECT_THAT(findings(analysis::Comparison{}), IsEmpty());
}

TEST(Findings, SayThatAllIsRight)
{
    EXPECT_THAT(findings(comparison_of(0, 0)), ElementsAre("All 200 scored pixels are right."));
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

/// One of whose pixels none is scored: 60 of background, and of each other class what is given.
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
              "40.0 % of the lit surface shadows itself (acne). Borders that the kernel softens on "
              "purpose are left out of this; they are 10.0 % of the surface.");
    EXPECT_EQ(sentences.back(), "100 % of the error is due to the map's resolution.");
}

TEST(Findings, TellTheRemedyBeforeTheCause)
{
    analysis::Comparison comparison = comparison_of(20, 4);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.diagnosis->curve.recommended = recommended(0.375F, 1);
    EXPECT_THAT(findings(comparison),
                ElementsAre("24.0 % of the lit surface shadows itself (acne).",
                            "bias.constant = 0.375 (1.5 m, 3 texels) leaves 0.500 % of the surface "
                            "wrong, in place of 12.0 %.",
                            "100 % of the error is due to the map's resolution."));
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

TEST(Findings, WarnOfARemedyThatTakesTheShadowsAway)
{
    analysis::Comparison comparison = comparison_of(80, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.advice = {rerun("bias.constant = 9", {0, 60})};
    EXPECT_EQ(findings(comparison)[1],
              "bias.constant = 9 leaves 30.0 % of the surface wrong, in place of 40.0 %; but it "
              "lights 60.0 % of the shadowed surface.");
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

TEST(Findings, PromiseNothingThatWasNotMeasured)
{
    analysis::Comparison comparison = comparison_of(10, 0);
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    EXPECT_THAT(findings(comparison)[1], HasSubstr("--advise measures it"));
    comparison.advice = {rerun("shadow_map.cull = \"none\"", {11, 0})};
    EXPECT_EQ(findings(comparison)[1], "None of 1 measured change leaves less.");
}

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
    setting.bias.pasted = {"bias.constant = 0.0009866967", 0.0009866967F};
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
    // The size of a fixed map beside another fit is refused.
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
    best.bias.pasted = {"bias.constant = 0.002", 0.002F};
    result.considered.push_back(best);
    EXPECT_EQ(changed_toml({"", result}),
              "shadow_map = { resolution = 2048, fit = \"scene\" } # and remove half_extent or "
              "fov_deg\nbias = { constant = 0.002 }\n");
}

} // namespace
} // namespace gnomon::reports
