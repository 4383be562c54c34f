#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_filter.hpp"
#include "analysis/gate/new_pixels.hpp"
#include "analysis/metrics/error_buckets.hpp"

#include "gate_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace gnomon::analysis {
namespace {

const std::vector<ErrorBucket> two_objects{
    {"floor", light_distance_band_of(4), 90, 10, {{false, Cause::resolution, Label::acne, 7, 6.5}}},
    {"floor", light_distance_band_of(8), 50, 0, {}},
    {"wall",
     light_distance_band_of(4),
     20,
     30,
     {{false, Cause::bias, Label::overshadow, 2, 2},
      {true, Cause::bias, Label::peter_panning, 5, 5.25}}}};

PixelFilter of_object(const std::string& name)
{
    PixelFilter filter;
    filter.object = name;
    return filter;
}

TEST(LightDistanceBands, AreTheOctavesOfTheDistance)
{
    const LightDistanceBand band = light_distance_band_of(4);
    EXPECT_EQ(band.lower_m(), 4);
    EXPECT_EQ(band.upper_m(), 8);
    EXPECT_EQ(light_distance_band_of(std::nextafter(8.0F, 0.0F)), band);
    EXPECT_EQ(light_distance_band_of(8).index, band.index + 1);
    EXPECT_EQ(light_distance_band_of(-4).lower_m(), -4) << "the lower end belongs to a band";
    EXPECT_EQ(light_distance_band_of(-4).upper_m(), -2);
    EXPECT_EQ(light_distance_band_of(std::nextafter(-4.0F, -5.0F)).lower_m(), -8);
}

TEST(LightDistanceBands, HoldAllDistances)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(light_distance_band_of(-infinity).index, LightDistanceBand::lowest);
    EXPECT_EQ(light_distance_band_of(infinity).index, LightDistanceBand::highest);
    EXPECT_EQ(light_distance_band_of(0).index, 0);
    EXPECT_EQ(light_distance_band_of(-0.0F).index, 0);
    EXPECT_EQ(light_distance_band_of(-std::numeric_limits<float>::denorm_min()).index, -1);
    for (int index = LightDistanceBand::lowest; index <= LightDistanceBand::highest; ++index) {
        const auto lower_m = static_cast<float>(LightDistanceBand{index}.lower_m());
        const auto upper_m = static_cast<float>(LightDistanceBand{index}.upper_m());
        EXPECT_EQ(light_distance_band_of(lower_m).index, index);
        EXPECT_EQ(light_distance_band_of(std::nextafter(upper_m, -infinity)).index, index);
        EXPECT_EQ(upper_m, LightDistanceBand{index + 1}.lower_m());
    }
}

TEST(PixelFilters, CountTheirPixels)
{
    PixelFilter filter = of_object("wall");
    EXPECT_EQ(metric_of_pixels(two_objects, "wrong_pixels", filter), 7);
    EXPECT_EQ(metric_of_pixels(two_objects, "false_lit_rate", filter), 5.0 / 30);
    EXPECT_EQ(metric_of_pixels(two_objects, "labels.overshadow", filter), 2);
    EXPECT_EQ(metric_of_pixels(two_objects, "pixels.lit", filter), 20);
    filter.cause = Cause::bias;
    EXPECT_EQ(metric_of_pixels(two_objects, "false_shadow", filter), 2);
    filter.cause = Cause::coverage;
    EXPECT_EQ(metric_of_pixels(two_objects, "wrong_pixels", filter), 0);
    EXPECT_EQ(metric_of_pixels(two_objects, "causes.bias", filter), 0);
    PixelFilter bands;
    bands.bands = LightDistanceBands{light_distance_band_of(4), light_distance_band_of(4)};
    EXPECT_EQ(metric_of_pixels(two_objects, "wrong_pixels", bands), 14);
    bands.bands->first = light_distance_band_of(8);
    bands.bands->last = light_distance_band_of(512);
    EXPECT_EQ(metric_of_pixels(two_objects, "error_rate", bands), 0);
}

TEST(PixelFilters, AddUpTheirAmounts)
{
    PixelFilter filter = of_object("wall");
    EXPECT_EQ(metric_of_pixels(two_objects, "error_amount", filter), 7.25);
    EXPECT_EQ(metric_of_pixels(two_objects, "shadow_amount", filter), 2);
    EXPECT_EQ(metric_of_pixels(two_objects, "light_amount_rate", filter), 5.25 / 30);
    EXPECT_EQ(metric_of_pixels(two_objects, "mean_abs_error", filter), 7.25 / 50);
    EXPECT_EQ(metric_of_pixels(two_objects, "label_amounts.peter_panning", filter), 5.25);
    EXPECT_EQ(metric_of_pixels(two_objects, "cause_amounts.resolution", filter), 0);
    filter.label = Label::overshadow;
    EXPECT_EQ(metric_of_pixels(two_objects, "error_amount", filter), 2);
    EXPECT_EQ(metric_of_pixels(two_objects, "error_amount", of_object("floor")), 6.5);
}

TEST(PixelFilters, KnowEveryKindOfErrorThatThereIs)
{
    PixelFilter filter;
    filter.cause = Cause::filter;
    EXPECT_TRUE(can_count("false_shadow", filter));
    EXPECT_TRUE(can_count("light_amount", filter));
    EXPECT_TRUE(can_count("label_amounts.bleed", filter));
    EXPECT_FALSE(can_count("labels.leak", filter)) << "nobody loses a blocker by filtering";
    filter.label = Label::bleed;
    EXPECT_FALSE(can_count("shadow_amount", filter));
}

TEST(PixelFilters, OfNoPixelsHaveNoValue)
{
    EXPECT_EQ(metric_of_pixels(two_objects, "wrong_pixels", of_object("walls")), std::nullopt);
    PixelFilter far = of_object("floor");
    far.bands = LightDistanceBands{light_distance_band_of(8), light_distance_band_of(8)};
    EXPECT_EQ(metric_of_pixels(two_objects, "false_lit_rate", far), std::nullopt) << "0 / 0";
}

TEST(EachObject, IsJudgedByItself)
{
    GateRule rule = gate_rule("wrong_pixels");
    rule.allow_pixels = 1;
    rule.each_object = true;
    const std::vector<GateRule> rules{rule};
    GateEntry before = gate_entry("1", {{"wrong_pixels", 14}});
    before.cells = two_objects;
    GateEntry now = before;
    now.cells[0].errors[0].pixels = 4; // three fewer
    now.cells[2].errors[1].pixels = 7; // two more
    now.cells[2].errors[1].amount = 7.25;
    now.cells.push_back({"zebra",
                         light_distance_band_of(4),
                         9,
                         9,
                         {{true, Cause::bias, Label::peter_panning, 9, 9}}});
    const GateOutcome outcome = judge_run(gate_entries({before}), gate_entries({now}), rules);
    ASSERT_EQ(outcome.findings.size(), 1U) << "a new object has nothing to be compared with";
    EXPECT_EQ(outcome.findings[0].filter, of_object("wall"));
    EXPECT_EQ(outcome.findings[0].cause, (DominantCause{"bias", 2}));
}

TEST(EachObject, IsHeldToItsAmountByTheDefaultRules)
{
    GateEntry before = gate_entry("1", {{"pixels.total", 1000}});
    before.cells = two_objects;
    GateEntry now = before;
    now.cells[0].errors[0].amount -= 1; // equally many pixels are wrong, the floor's by less,
    now.cells[2].errors[1].amount += 1; // the wall's by more: the total is unchanged
    const std::vector<GateRule> rules = default_gate_rules();
    const GateOutcome outcome = judge_run(gate_entries({before}), gate_entries({now}), rules);
    ASSERT_EQ(outcome.findings.size(), 1U);
    EXPECT_EQ(rules[outcome.findings[0].rule].metric, "error_amount");
    EXPECT_EQ(outcome.findings[0].filter, of_object("wall"));
}

TEST(AnObjectThatNobodyShows, MatchesNothing)
{
    GateRule rule = gate_rule("wrong_pixels");
    rule.max = 0;
    rule.pixels = of_object("walls");
    GateEntry entry = gate_entry("1", {});
    entry.cells = two_objects;
    const GateEntries run = gate_entries({entry});
    const std::vector<GateRule> rules{rule};
    EXPECT_EQ(judge_run(run, run, rules).unmatched_rules, std::vector<std::size_t>{0});
}

WrongPixels sized_pixels(scene::ImageSize size)
{
    WrongPixels wrong;
    wrong.mask = PixelMask{size};
    wrong.cause = scene::Image<Cause>{size};
    wrong.label = scene::Image<Label>{size};
    wrong.object = scene::Image<std::uint32_t>{size};
    wrong.objects = {"floor"};
    wrong.light_distance_m = scene::Image<float>{size, 5};
    return wrong;
}

TEST(NewPixels, AreThoseThatWereRight)
{
    WrongPixels now = sized_pixels({5, 4});
    PixelMask before{{5, 4}};
    before(1, 1) = 1;
    for (const auto& [x, y] : {std::pair{1, 1}, {4, 1}, {0, 3}}) {
        now.mask(x, y) = 1;
        now.cause(x, y) = Cause::precision;
    }
    const NewPixels found = find_new_pixels(before, now, {});
    EXPECT_EQ(found.count, 2U);
    EXPECT_EQ(found.first, (std::vector<PixelPlace>{{4, 1}, {0, 3}}));
    EXPECT_EQ(found.lower, (PixelPlace{0, 1}));
    EXPECT_EQ(found.upper, (PixelPlace{4, 3}));
    EXPECT_EQ(found.cause, (DominantCause{"precision", 2}));
    EXPECT_EQ(find_new_pixels(now.mask, now, {}).count, 0U);
    EXPECT_THROW((void)find_new_pixels(PixelMask{{4, 5}}, now, {}), std::invalid_argument);
}

TEST(NewPixels, CanBeOfOneObjectCauseOrBand)
{
    WrongPixels now = sized_pixels({2, 1});
    now.mask = PixelMask{{2, 1}, 1};
    now.cause = scene::Image<Cause>{{2, 1}, Cause::bias};
    now.object(1, 0) = 7; // out of range of the names
    const PixelMask before{{2, 1}};
    EXPECT_EQ(find_new_pixels(before, now, of_object("floor")).count, 1U);
    PixelFilter filter;
    filter.cause = Cause::coverage;
    EXPECT_EQ(find_new_pixels(before, now, filter).count, 0U);
    filter.cause = Cause::bias;
    filter.bands = LightDistanceBands{light_distance_band_of(4), light_distance_band_of(4)};
    EXPECT_EQ(find_new_pixels(before, now, filter).count, 2U);
    EXPECT_TRUE(now.knows(filter));
    now.light_distance_m = {};
    EXPECT_FALSE(now.knows(filter));
}

/// Judges one configuration by a rule on new pixels, of which there are 3, with or without kept
/// pixels.
GateOutcome judged_new_pixels(bool has_mask, bool has_pixels, const GateRule& rule)
{
    GateEntry before = gate_entry("1", {});
    GateEntry now = before;
    before.pixels = has_mask ? "mask" : "";
    now.pixels = has_pixels ? "id" : "";
    const std::vector<GateRule> rules{rule};
    return judge_run(gate_entries({before}), gate_entries({now}), rules,
                     [](const auto&, const auto&, const auto&) {
                         return NewPixelAnswer{NewPixels{3, {}, {}, {}, {}}, {}};
                     });
}

TEST(NewPixelRules, JudgeWhatBothHave)
{
    GateRule rule = gate_rule("new_pixels");
    rule.allow_pixels = 2;
    const GateOutcome outcome = judged_new_pixels(true, true, rule);
    ASSERT_EQ(outcome.findings.size(), 1U);
    EXPECT_EQ(outcome.findings[0].now, 3);
    EXPECT_EQ(outcome.findings[0].before, 0);
    rule.allow_pixels = 3;
    EXPECT_TRUE(judged_new_pixels(true, true, rule).findings.empty());
    rule.allow_pixels.reset();
    rule.max = 2;
    EXPECT_EQ(judged_new_pixels(true, true, rule).findings[0].reason, GateReason::above_max);
}

TEST(NewPixelRules, CannotJudgeWhatOneSideLacks)
{
    GateRule rule = gate_rule("new_pixels");
    rule.allow_pixels = 0;
    const std::vector<GateRule> rules{rule};
    for (const auto& [has_mask, has_pixels] :
         {std::pair{true, false}, {false, true}, {false, false}}) {
        const GateOutcome outcome = judged_new_pixels(has_mask, has_pixels, rule);
        ASSERT_EQ(outcome.findings.size(), 1U);
        EXPECT_EQ(outcome.findings[0].reason, GateReason::not_available);
        EXPECT_EQ(gate_verdict(outcome, rules, true), GateVerdict::incomplete);
    }
    rule.is_optional = true;
    EXPECT_TRUE(judged_new_pixels(false, true, rule).findings.empty());
    EXPECT_EQ(judged_new_pixels(true, false, rule).findings.size(), 1U);
}

TEST(BaselineUpdates, TakeWhatTheyName)
{
    const auto entry = [](const char* bias, double wrong) {
        return gate_entry(bias, {{"false_lit", wrong}});
    };
    const GateEntries baseline = gate_entries({entry("1", 10), entry("2", 20), entry("3", 30)});
    const GateEntries run = gate_entries({entry("2", 21), entry("3", 30), entry("4", 40)});
    const auto values = [&](BaselineUpdate update) {
        std::vector<double> wrong;
        for (const GateEntry& one : updated_baseline(baseline, run, update).entries) {
            wrong.push_back(one.metrics.at("false_lit"));
        }
        return wrong;
    };
    EXPECT_EQ(values(BaselineUpdate::missing), (std::vector<double>{10, 20, 30, 40}));
    EXPECT_EQ(values(BaselineUpdate::changed), (std::vector<double>{10, 21, 30}));
    EXPECT_EQ(values(BaselineUpdate::all), (std::vector<double>{21, 30, 40}));
}

TEST(BaselineUpdates, DoNotUniteRenderers)
{
    const GateEntries baseline = gate_entries({gate_entry("1", {})});
    GateEntries run = baseline;
    run.environment.gl_renderer = "another";
    EXPECT_THROW((void)updated_baseline(baseline, run, BaselineUpdate::changed),
                 std::invalid_argument);
    EXPECT_EQ(updated_baseline(baseline, run, BaselineUpdate::all).environment.gl_renderer,
              "another");
}

TEST(CurvePoints, AreMetricsAtAnyBias)
{
    const auto point = curve_point_metric("bias_curve.at(1e-3).false_lit");
    ASSERT_TRUE(point.has_value());
    EXPECT_EQ(point->bias, 0.001);
    EXPECT_EQ(point->name(), "bias_curve.at(0.001).false_lit");
    EXPECT_TRUE(find_gate_metric(point->name())->is_pixel_count);
    EXPECT_FALSE(find_gate_metric("bias_curve.at(0).error_rate")->is_pixel_count);
    for (const char* const text :
         {"bias_curve.at().false_lit", "bias_curve.at(nan).false_lit", "bias_curve.at(1).curve",
          "bias_curve.at(1", "bias_curve.at(1).", "bias_curve.at(1).false_lit "}) {
        EXPECT_EQ(find_gate_metric(text), nullptr) << text;
    }
}

} // namespace
} // namespace gnomon::analysis
