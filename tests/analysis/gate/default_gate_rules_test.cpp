#include "analysis/gate/gate_rules.hpp"

#include "analysis/gate/gate_judgement.hpp"
#include "gate_case.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {
namespace {

TEST(DefaultGateRules, AllowNothingWhileTheJobIsUnchanged)
{
    const std::vector<GateRule> rules = default_gate_rules();
    const auto verdict = [&](double pixels, const std::string& bias_slope,
                             const std::string& renderer) {
        const auto entry = [](double wrong, const std::string& slope) {
            return gate_entries(
                {gate_entry("1", {{"false_shadow", wrong}, {"pixels.total", 100'000}},
                            {{"bias.slope", slope}})});
        };
        GateEntries now = entry(pixels, bias_slope);
        now.environment.gl_renderer = renderer;
        return gate_verdict(judge_run(entry(50, "0"), now, rules), rules, true);
    };
    EXPECT_EQ(verdict(50, "0", "llvmpipe"), GateVerdict::pass);
    EXPECT_EQ(verdict(51, "0", "llvmpipe"), GateVerdict::regression);
    // 1 of 100,000 pixels.
    EXPECT_EQ(verdict(51, "1", "llvmpipe"), GateVerdict::pass);
    EXPECT_EQ(verdict(52, "1", "llvmpipe"), GateVerdict::regression);
    EXPECT_EQ(verdict(51, "0", "another"), GateVerdict::pass);
    EXPECT_EQ(verdict(52, "0", "another"), GateVerdict::regression);
}

/// The default rules' verdict on a changed job, and the findings' reasons.
std::pair<GateVerdict, std::vector<GateReason>>
judged_change(const std::map<std::string, double>& before, const std::map<std::string, double>& now)
{
    const std::vector<GateRule> rules = default_gate_rules();
    const GateOutcome outcome =
        judge_run(gate_entries({gate_entry("1", before, {{"bias.slope", "0"}})}),
                  gate_entries({gate_entry("1", now, {{"bias.slope", "1"}})}), rules);
    std::vector<GateReason> reasons;
    for (const GateFinding& finding : outcome.findings) {
        reasons.push_back(finding.reason);
    }
    return {gate_verdict(outcome, rules, true), reasons};
}

TEST(DefaultGateRules, LetAnImprovementHaveItsPrice)
{
    const auto [passes, warnings] = judged_change({{"false_shadow", 1000}, {"false_lit", 0}},
                                                  {{"false_shadow", 0}, {"false_lit", 90}});
    EXPECT_EQ(passes, GateVerdict::pass);
    EXPECT_EQ(warnings, std::vector<GateReason>{GateReason::traded_off});
    // A tenth of the fall, 1000 - 91, is less than 91.
    EXPECT_EQ(judged_change({{"false_shadow", 1000}, {"false_lit", 0}},
                            {{"false_shadow", 0}, {"false_lit", 91}})
                  .first,
              GateVerdict::regression);
}

TEST(DefaultGateRules, HoldAmountsAsTheyHoldCounts)
{
    EXPECT_EQ(judged_change({{"shadow_amount", 10}, {"pixels.total", 100'000}},
                            {{"shadow_amount", 11.5}, {"pixels.total", 100'000}})
                  .first,
              GateVerdict::regression);
    // Traded off by the fall of both amounts; no count changed.
    const auto [passes, warnings] = judged_change({{"shadow_amount", 1000}, {"light_amount", 0}},
                                                  {{"shadow_amount", 0}, {"light_amount", 90}});
    EXPECT_EQ(passes, GateVerdict::pass);
    EXPECT_EQ(warnings, std::vector<GateReason>{GateReason::traded_off});
    EXPECT_EQ(judged_change({{"mean_abs_error", 0.1}}, {{"mean_abs_error", 0.1002}}).first,
              GateVerdict::regression);
    EXPECT_EQ(judged_change({{"mean_abs_error", 0.1}}, {{"mean_abs_error", 0.10009}}).first,
              GateVerdict::pass);
}

TEST(DefaultGateRules, FailWhereNothingIsTested)
{
    const auto scored = [](double lit, double blocked) {
        return std::map<std::string, double>{{"pixels.lit", lit}, {"pixels.blocked", blocked}};
    };
    using Reasons = std::vector<GateReason>;
    EXPECT_EQ(judged_change(scored(500, 500), scored(900, 0)).second, Reasons{});
    const auto [verdict, reasons] = judged_change(scored(500, 500), scored(0, 899));
    EXPECT_EQ(verdict, GateVerdict::regression);
    EXPECT_EQ(reasons, Reasons{GateReason::nothing_tested});
    EXPECT_EQ(judged_change(scored(0, 0), scored(0, 0)).second,
              Reasons{GateReason::nothing_tested});
    // More scored pixels are no improvement, nor are errors that nobody could see.
    const std::vector<GateRule> rules = default_gate_rules();
    const auto improvements = [&](std::map<std::string, double> now) {
        return judge_run(gate_entries({gate_entry("1",
                                                  {{"pixels.lit", 10},
                                                   {"pixels.blocked", 0},
                                                   {"false_shadow", 5},
                                                   {"false_lit", 0}},
                                                  {{"bias.slope", "0"}})}),
                         gate_entries({gate_entry("1", std::move(now), {{"bias.slope", "1"}})}),
                         rules)
            .improvements.size();
    };
    EXPECT_EQ(
        improvements(
            {{"pixels.lit", 20}, {"pixels.blocked", 0}, {"false_shadow", 5}, {"false_lit", 0}}),
        0U);
    EXPECT_EQ(
        improvements(
            {{"pixels.lit", 0}, {"pixels.blocked", 0}, {"false_shadow", 0}, {"false_lit", 0}}),
        0U);
}

TEST(DefaultGateRules, HoldTheClassesOfAnUnchangedJob)
{
    const std::vector<GateRule> rules = default_gate_rules();
    const auto run = [](double lit) {
        return gate_entries({gate_entry("1", {{"pixels.lit", lit}, {"pixels.blocked", 5}})});
    };
    const auto verdict = [&](double lit) {
        return gate_verdict(judge_run(run(10), run(lit), rules), rules, true);
    };
    EXPECT_EQ(verdict(10), GateVerdict::pass);
    EXPECT_EQ(verdict(9), GateVerdict::regression);
    EXPECT_EQ(verdict(11), GateVerdict::regression);
}

TEST(DefaultGateRules, LetPixelsThatStayWrongChangeTheirCause)
{
    const std::map<std::string, double> before{{"false_shadow", 1000},
                                               {"false_lit", 0},
                                               {"causes.precision", 1000},
                                               {"causes.resolution", 0}};
    const auto now = [](double wrong) {
        return std::map<std::string, double>{{"false_shadow", wrong},
                                             {"false_lit", 0},
                                             {"causes.precision", 0},
                                             {"causes.resolution", wrong}};
    };
    EXPECT_EQ(judged_change(before, now(999)).first, GateVerdict::pass);
    EXPECT_EQ(judged_change(before, now(1000)).first, GateVerdict::pass);
    EXPECT_EQ(judged_change(before, now(1001)).first, GateVerdict::regression);
}

TEST(DefaultGateRules, AllowNoMismatch)
{
    const std::vector<GateRule> rules = default_gate_rules();
    const GateEntries run = gate_entries({gate_entry("1", {{"unmatched_kinds.mismatch", 1}})});
    EXPECT_EQ(gate_verdict(judge_run(run, run, rules), rules, true), GateVerdict::regression);
}

} // namespace
} // namespace gnomon::analysis
