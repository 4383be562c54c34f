#include "analysis/gate/gate_judgement.hpp"

#include "gate_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gnomon::analysis {
namespace {

std::vector<GateFinding> findings_of(const GateEntries& before, const GateEntries& now,
                                     const GateRule& rule)
{
    const std::vector<GateRule> rules{rule};
    return judge_run(before, now, rules).findings;
}

TEST(GateLimits, MaxAndMinHoldAtTheirValue)
{
    GateRule rule = gate_rule("error_rate");
    rule.max = 0.5;
    rule.min = 0.25;
    EXPECT_EQ(finding_count(rule, 0, 0.5), 0U);
    EXPECT_EQ(finding_count(rule, 0, 0.25), 0U);
    const GateOutcome above = judged(rule, 0, std::nextafter(0.5, 1));
    ASSERT_EQ(above.findings.size(), 1U);
    EXPECT_EQ(above.findings[0].reason, GateReason::above_max);
    EXPECT_EQ(above.findings[0].limit, 0.5);
    const GateOutcome below = judged(rule, 0, std::nextafter(0.25, 0));
    ASSERT_EQ(below.findings.size(), 1U);
    EXPECT_EQ(below.findings[0].reason, GateReason::below_min);
}

TEST(GateLimits, AbsIsTheLargestChange)
{
    GateRule rule = gate_rule("error_rate");
    rule.abs = 0.25;
    EXPECT_EQ(finding_count(rule, 0.5, 0.75), 0U);
    const GateOutcome outcome = judged(rule, 0.5, std::nextafter(0.75, 1));
    ASSERT_EQ(outcome.findings.size(), 1U);
    EXPECT_EQ(outcome.findings[0].reason, GateReason::worse_than_baseline);
    EXPECT_EQ(outcome.findings[0].before, 0.5);
    EXPECT_EQ(outcome.findings[0].limit, 0.25);
}

TEST(GateLimits, RelIsOfTheBaseline)
{
    GateRule rule = gate_rule("false_lit");
    rule.rel = 0.5;
    EXPECT_EQ(finding_count(rule, 100, 150), 0U);
    EXPECT_EQ(finding_count(rule, 100, 151), 1U);
    EXPECT_EQ(finding_count(rule, 0, 1), 1U) << "half of nothing";
}

TEST(GateLimits, PixelsAreAllowedByNumberAndByShareOfTheImage)
{
    GateRule number = gate_rule("false_lit");
    number.allow_pixels = 3;
    EXPECT_EQ(finding_count(number, 7, 10), 0U);
    EXPECT_EQ(finding_count(number, 7, 11), 1U);
    GateRule share = gate_rule("false_lit");
    share.allow_share = 0.0005; // 5 of 10,000 pixels
    EXPECT_EQ(finding_count(share, 7, 12), 0U);
    EXPECT_EQ(finding_count(share, 7, 13), 1U);
}

TEST(GateLimits, TheLargestOfSeveralAllowancesCounts)
{
    GateRule rule = gate_rule("false_lit");
    rule.rel = 0.1;
    rule.allow_pixels = 3;
    EXPECT_EQ(finding_count(rule, 10, 13), 0U);
    EXPECT_EQ(finding_count(rule, 10, 14), 1U);
    EXPECT_EQ(finding_count(rule, 100, 110), 0U);
    EXPECT_EQ(finding_count(rule, 100, 111), 1U);
}

TEST(GateDirection, SaysWhichChangeIsWorse)
{
    GateRule rule = gate_rule("bias_curve.panning_free");
    EXPECT_EQ(rule.worse, Worse::down);
    rule.abs = 0;
    EXPECT_EQ(finding_count(rule, 1, 2), 0U);
    EXPECT_EQ(finding_count(rule, 2, 1), 1U);
    rule.worse = Worse::up;
    EXPECT_EQ(finding_count(rule, 1, 2), 1U);
    EXPECT_EQ(finding_count(rule, 2, 1), 0U);
    rule.worse = Worse::both;
    EXPECT_EQ(finding_count(rule, 1, 2), 1U);
    EXPECT_EQ(finding_count(rule, 2, 1), 1U);
    EXPECT_EQ(finding_count(rule, 1, 1), 0U);
}

TEST(GateImprovements, AreReportedOnceAndPass)
{
    GateRule rule = gate_rule("false_lit");
    rule.allow_pixels = 0;
    GateRule other = rule;
    other.id = "another";
    const std::vector<GateRule> rules{rule, other};
    const GateOutcome outcome =
        judge_run(gate_entries({gate_entry("0", {{"false_lit", 9}})}),
                  gate_entries({gate_entry("0", {{"false_lit", 4}})}), rules);
    EXPECT_EQ(gate_verdict(outcome, rules, true), GateVerdict::pass);
    ASSERT_EQ(outcome.improvements.size(), 1U);
    EXPECT_EQ(outcome.improvements[0].before, 9);
    EXPECT_EQ(outcome.improvements[0].now, 4);
}

TEST(GateFindings, StandWithTheWorstFirst)
{
    const auto rules = [] {
        GateRule pixels = gate_rule("false_lit");
        pixels.allow_pixels = 0;
        GateRule gap = gate_rule("peter_panning_gap_m.max");
        gap.abs = 0;
        GateRule warning = gate_rule("false_shadow");
        warning.max = 0;
        warning.severity = Severity::warn;
        return std::vector<GateRule>{warning, gap, pixels};
    }();
    const auto entry = [](const std::string& bias, double lit, double gap) {
        return gate_entry(
            bias, {{"false_lit", lit}, {"peter_panning_gap_m.max", gap}, {"false_shadow", 1e6}});
    };
    const GateOutcome outcome =
        judge_run(gate_entries({entry("1", 10, 0.5), entry("2", 10, 0.5)}),
                  gate_entries({entry("1", 11, 9), entry("2", 99, 0.5)}), rules);
    ASSERT_EQ(outcome.findings.size(), 5U);
    EXPECT_EQ(outcome.findings[0].rule, 2U);
    EXPECT_EQ(outcome.findings[0].entry, 1U);
    EXPECT_EQ(outcome.findings[1].rule, 2U);
    EXPECT_EQ(outcome.findings[2].rule, 1U);
    EXPECT_EQ(outcome.findings[3].rule, 0U);
    EXPECT_EQ(outcome.broken(rules, Severity::fail), 3U);
    EXPECT_EQ(outcome.broken(rules, Severity::warn), 2U);
    EXPECT_EQ(gate_verdict(outcome, rules, true), GateVerdict::regression);
}

TEST(GateFindings, WarningsPass)
{
    GateRule rule = gate_rule("false_lit");
    rule.max = 0;
    rule.severity = Severity::warn;
    const std::vector<GateRule> rules{rule};
    EXPECT_EQ(gate_verdict(judged(rule, 0, 1), rules, true), GateVerdict::pass);
}

TEST(GateMatching, SaysWhichConfigurationsAreMissingAndNew)
{
    const std::vector<GateRule> rules;
    const GateOutcome outcome =
        judge_run(gate_entries({gate_entry("10", {}), gate_entry("9", {})}),
                  gate_entries({gate_entry("9", {}), gate_entry("1e2", {})}), rules);
    ASSERT_EQ(outcome.pairs.size(), 1U);
    EXPECT_EQ(outcome.pairs[0].before, 0U) << "9 stands before 10";
    EXPECT_EQ(outcome.missing, std::vector<std::size_t>{1});
    EXPECT_EQ(outcome.added, std::vector<std::size_t>{1});
    EXPECT_EQ(gate_verdict(outcome, rules, true), GateVerdict::incomplete);
}

TEST(GateMatching, NewConfigurationsPassButForAbsoluteLimits)
{
    GateRule rule = gate_rule("false_lit");
    rule.allow_pixels = 0;
    const GateEntries before = gate_entries({gate_entry("1", {{"false_lit", 0}})});
    const GateEntries now =
        gate_entries({gate_entry("1", {{"false_lit", 0}}), gate_entry("2", {{"false_lit", 5}})});
    EXPECT_TRUE(findings_of(before, now, rule).empty());
    rule.max = 4;
    EXPECT_EQ(findings_of(before, now, rule).size(), 1U);
}

TEST(GateMatching, ARuleThatMatchesNothingIsNamedUnlessOptional)
{
    GateRule rule = gate_rule("causes.bias");
    rule.max = 0;
    std::vector<GateRule> rules{rule, rule, gate_rule("false_lit")};
    rules[1].is_optional = true;
    rules[2].max = 5;
    rules[2].where = {{"light.type", "spot"}};
    const GateEntries run =
        gate_entries({gate_entry("1", {{"false_lit", 0}}, {{"light.type", "directional"}})});
    EXPECT_EQ(judge_run(run, run, rules).unmatched_rules, (std::vector<std::size_t>{0, 2}));
}

TEST(GateMatching, WhereComparesNumbersByTheirValue)
{
    GateRule rule = gate_rule("false_lit");
    rule.where = {{"bias.constant", "0.001"}, {"light.type", "spot"}};
    const GateEntry entry = gate_entry("1e-03", {}, {{"light.type", "spot"}});
    EXPECT_TRUE(is_meant(rule, entry, true));
    rule.where["bias.constant"] = "0.01";
    EXPECT_FALSE(is_meant(rule, entry, true));
    rule.where = {{"case", ""}};
    EXPECT_TRUE(is_meant(rule, entry, true));
}

TEST(GateAvailability, AValueOnOneSideAloneIsNotJudgedAndDoesNotPass)
{
    GateRule rule = gate_rule("causes.bias");
    rule.allow_pixels = 0;
    const std::vector<GateRule> rules{rule};
    const GateEntries with = gate_entries({gate_entry("1", {{"causes.bias", 3}})});
    const GateEntries without = gate_entries({gate_entry("1", {})});
    for (const auto& [before, now] : {std::pair{with, without}, {without, with}}) {
        const GateOutcome outcome = judge_run(before, now, rules);
        ASSERT_EQ(outcome.findings.size(), 1U);
        EXPECT_EQ(outcome.findings[0].reason, GateReason::not_available);
        EXPECT_EQ(gate_verdict(outcome, rules, true), GateVerdict::incomplete);
    }
}

TEST(GateAvailability, WithoutGapsTheirLengthIsZero)
{
    GateRule rule = gate_rule("peter_panning_gap_m.p95");
    rule.abs = 0;
    const GateEntries none = gate_entries({gate_entry("1", {{"peter_panning_gap_pixels", 0}})});
    const GateEntries some = gate_entries(
        {gate_entry("1", {{"peter_panning_gap_pixels", 2}, {"peter_panning_gap_m.p95", 0.25}})});
    EXPECT_TRUE(findings_of(some, none, rule).empty());
    const std::vector<GateFinding> findings = findings_of(none, some, rule);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].reason, GateReason::worse_than_baseline);
    EXPECT_EQ(findings[0].before, 0);
}

TEST(GateVerdicts, AnIncompleteRunDecidesNothing)
{
    GateRule rule = gate_rule("false_lit");
    rule.max = 0;
    const std::vector<GateRule> rules{rule};
    EXPECT_EQ(gate_verdict(judged(rule, 0, 1), rules, true), GateVerdict::regression);
    EXPECT_EQ(gate_verdict(judged(rule, 0, 1), rules, false), GateVerdict::incomplete);
    EXPECT_EQ(gate_verdict(judged(rule, 0, 0), rules, false), GateVerdict::incomplete);
}

TEST(GateSuspects, AreTheChangedParametersAndTheCauseThatGrewMost)
{
    const GateEntry before = gate_entry(
        "1", {{"causes.bias", 90}, {"causes.precision", 1}, {"causes.resolution", 5}},
        {{"bias.slope", "1"}, {"shadow_map.depth_format", "d24"}, {"shadow_map.near", "0.1"}});
    const GateEntry now = gate_entry(
        "1", {{"causes.bias", 99}, {"causes.precision", 21}, {"causes.resolution", 4}},
        {{"bias.slope", "1"}, {"shadow_map.depth_format", "d16"}, {"shadow_map.far", "9"}});
    EXPECT_EQ(changed_parameters(before, now),
              (std::vector<ParameterChange>{{"shadow_map.depth_format", "d24", "d16"},
                                            {"shadow_map.far", "auto", "9"},
                                            {"shadow_map.near", "0.1", "auto"}}));
    EXPECT_EQ(dominant_cause(before, now), (DominantCause{"precision", 20}));
    EXPECT_EQ(dominant_cause(now, now), std::nullopt);
}

TEST(GateSuspects, AKeyThatIsNewHadItsDefault)
{
    const GateEntry before = gate_entry("1", {}, {{"lookup.filter", "pcf3"}});
    const auto with = [](const char* position) {
        return gate_entry("1", {}, {{"lookup.filter", "pcf3"}, {"lookup.position", position}});
    };
    EXPECT_TRUE(changed_parameters(before, with("vertex")).empty());
    EXPECT_EQ(changed_parameters(before, with("pixel")),
              (std::vector<ParameterChange>{{"lookup.position", "vertex", "pixel"}}));
    const GateEntry placed =
        gate_entry("1", {}, {{"lookup.filter", "pcf3"}, {"camera.eye", "[1, 2, 3]"}});
    EXPECT_EQ(changed_parameters(before, placed).size(), 1U) << "a camera has no default";
}

TEST(GateSuspects, APathCountsOnlyForAnotherScene)
{
    const auto entry = [](const std::string& file, const std::string& hash) {
        return gate_entry("1", {}, {{"scene.file", file}, {"scene_hash", hash}});
    };
    EXPECT_TRUE(changed_parameters(entry("/a/x.glb", "1"), entry("/b/x.glb", "1")).empty());
    EXPECT_EQ(changed_parameters(entry("/a/x.glb", "1"), entry("/b/x.glb", "2")).size(), 2U);
}

TEST(GateRuleOfScoredPixels, MayLimitThemFromAboveToo)
{
    GateRule rule;
    rule.id = "not too many";
    rule.metric = scored_pixels_metric;
    rule.max = 5;
    const std::vector<GateRule> rules{rule};
    const GateEntries run =
        gate_entries({gate_entry("1", {{"pixels.lit", 6}, {"pixels.blocked", 0}})});
    const GateOutcome outcome = judge_run(run, run, rules);
    ASSERT_EQ(outcome.findings.size(), 1U);
    EXPECT_EQ(outcome.findings[0].reason, GateReason::above_max);
}

} // namespace
} // namespace gnomon::analysis
