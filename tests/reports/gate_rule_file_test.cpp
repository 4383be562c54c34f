#include "reports/gate/gate_rule_file.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace gnomon::reports {
namespace {

using analysis::GateRule;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The error of a bad rule file; empty if it is valid.
std::string rule_refusal(const std::string& text)
{
    try {
        (void)parse_gate_rules(text, "gate.toml");
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return {};
}

/// A rule with an additional fourth line.
std::string rule_with(const std::string& line)
{
    return fmt::format("[[rule]]\nid = \"a\"\nmetric = \"false_lit\"\n{}\n", line);
}

TEST(GateRuleFile, ReadsEveryKey)
{
    const auto rules = parse_gate_rules(R"(
[[rule]]
id = "leaks"
metric = "labels.leak"
where = {shadow_map.resolution = 512, "light.type" = "spot", case = "noon"}
job = "changed"
max = 100
min = 0
abs = 1
rel = 0.5
allow_pixels = 3
allow_share = 1e-3
direction = "both"
severity = "warn"
optional = true

[[rule]]
id = "limit"
metric = "bias_curve.panning_free"
abs = 1e-3
)",
                                        "gate.toml");
    ASSERT_EQ(rules.size(), 2U);
    const analysis::GateRule& rule = rules[0];
    EXPECT_EQ(rule.id, "leaks");
    EXPECT_EQ(rule.metric, "labels.leak");
    EXPECT_EQ(rule.where,
              (std::map<std::string, std::string>{
                  {"shadow_map.resolution", "512"}, {"light.type", "spot"}, {"case", "noon"}}));
    EXPECT_EQ(rule.job, analysis::JobState::changed);
    EXPECT_EQ(rule.max, 100);
    EXPECT_EQ(rule.min, 0);
    EXPECT_EQ(rule.abs, 1);
    EXPECT_EQ(rule.rel, 0.5);
    EXPECT_EQ(rule.allow_pixels, 3);
    EXPECT_EQ(rule.allow_share, 1e-3);
    EXPECT_EQ(rule.worse, analysis::Worse::both);
    EXPECT_EQ(rule.severity, analysis::Severity::warn);
    EXPECT_TRUE(rule.is_optional);
    EXPECT_EQ(rule.place, "gate.toml:3");
    EXPECT_EQ(rules[1].worse, analysis::Worse::down) << "unless the rule says otherwise";
    EXPECT_EQ(rules[1].severity, analysis::Severity::fail);
    EXPECT_FALSE(rules[1].is_optional);
}

TEST(GateRuleFile, RefusesWithFileLineAndKey)
{
    const std::vector<std::pair<std::string, std::string>> bad{
        {rule_with("maxx = 1"), "gate.toml:4: maxx: is not a key of a rule; nearest: max"},
        {rule_with("max = \"1\""), "gate.toml:4: max: \"1\" is not a finite number"},
        {rule_with("max = nan"), "gate.toml:4: max: "},
        {rule_with("abs = inf"), "gate.toml:4: abs: "},
        {rule_with("abs = -1"), "gate.toml:4: abs: -1 is not a number from 0 up"},
        {rule_with("rel = -0.5"), "gate.toml:4: rel: "},
        {rule_with("allow_pixels = 1.5"), "gate.toml:4: allow_pixels: "},
        {rule_with("allow_pixels = -1"), "gate.toml:4: allow_pixels: "},
        {rule_with("allow_pixels = 99999999999999999999"), "gate.toml:4:"},
        {rule_with("allow_share = 2"), "gate.toml:4: allow_share: "},
        {rule_with("direction = \"left\""), "gate.toml:4: direction: \"left\" is not"},
        {rule_with("severity = 1"), "gate.toml:4: severity: 1 is not a string"},
        {rule_with("severity = \"bad\""), "gate.toml:4: severity: "},
        {rule_with("optional = \"yes\""), "gate.toml:4: optional: "},
        {rule_with("job = \"new\""), "gate.toml:4: job: "},
        {rule_with("where = 3"), "gate.toml:4: where: "},
        {rule_with("where = {}"), "gate.toml:4: where: "},
        {rule_with("where = {bias.konstant = 1}"),
         "gate.toml:4: konstant: bias.konstant is not a key of a job; nearest: bias.constant"},
        {rule_with("where = {bias.constant = [1]}"), "gate.toml:4: constant: "},
        {rule_with("where = {camera.eye = [1, 2, \"x\"]}"), "gate.toml:4: eye: "},
        {rule_with("trade_off = -1"), "gate.toml:4: trade_off: "},
        {rule_with("max = 1\ntrade_off = 1"), "has a trade_off, which needs abs, rel"},
        {rule_with("where = {bias.constant = 1979-05-27}"), "gate.toml:4: constant: "},
        {rule_with("max = 1\nmax = 2"), "gate.toml:5:"},
        {rule_with("max = 1\nmin = 2"), "has a max below its min"},
        {rule_with(""), "gate.toml:2: id: rule \"a\" has no limit"},
        {rule_with("max = 1") + rule_with("max = 1"), "the id \"a\" is used twice"},
        {"[[rule]]\nmetric = \"false_lit\"\nmax = 1", "has no id or no metric"},
        {"[[rule]]\nid = \"a\"\nmax = 1", "has no id or no metric"},
        {"[[rule]]\nid = \"\"\nmetric = \"false_lit\"\nmax = 1", "gate.toml:2: id: "},
        {"[[rule]]\nid = \"a\\nb\"\nmetric = \"false_lit\"\nmax = 1", "gate.toml:2: id: "},
        {"[[rule]]\nid = \"a\"\nmetric = \"false_light\"\nmax = 1",
         "gate.toml:3: metric: \"false_light\" is not a metric; nearest: \"false_lit\""},
        {"[[rule]]\nid = \"a\"\nmetric = \"error_rate\"\nallow_pixels = 1",
         "error_rate does not count pixels"},
        {"[[rule]]", "an element is empty"},
        {"rule = 3", "gate.toml:1: rule: is not a list"},
        {"rule = [3]", "gate.toml:1: rule: "},
        {"[rule]\nid = \"a\"", "gate.toml:1: rule: is not a list"},
        {"[[rules]]\nid = \"a\"", "gate.toml:1: rules: is unknown"},
        {"", "contains no rule"},
        {"rule = []", "contains no rule"},
        {"[[rule]\n", "not TOML"},
        {"rule = " + std::string(100'000, '['), "nested more than 32 deep"},
        {std::string("[[rule]]\nid = \"a\0\"", 17), "not TOML"}};
    for (const auto& [text, wanted] : bad) {
        EXPECT_THAT(rule_refusal(text), AllOf(HasSubstr(wanted), Not(HasSubstr("\n"))))
            << text.substr(0, 200);
    }
}

TEST(GateRuleFile, RefusesWhatCannotBeRead)
{
    EXPECT_THROW((void)read_gate_rules("/nowhere/gate.toml"), scene::InputError);
    EXPECT_THROW((void)read_gate_rules("/"), scene::InputError);
}

TEST(GateRuleFile, ReadsWhichPixelsAreMeant)
{
    const auto rule = [](const std::string& metric, const std::string& where) {
        return parse_gate_rules(
            fmt::format("[[rule]]\nid = \"a\"\nmetric = \"{}\"\nabs = 0\nwhere = {{{}}}", metric,
                        where),
            "gate.toml")[0];
    };
    const GateRule all = rule("false_lit_rate", "object = \"wall\", cause = \"bias\", label = "
                                                "\"peter_panning\", zeta_band = [4, 16.0]");
    EXPECT_EQ(all.pixels.object, "wall");
    EXPECT_EQ(all.pixels.cause, analysis::Cause::bias);
    EXPECT_EQ(all.pixels.label, analysis::Label::peter_panning);
    EXPECT_EQ(all.pixels.bands,
              (analysis::LightDistanceBands{analysis::light_distance_band_of(4),
                                            analysis::light_distance_band_of(8)}));
    EXPECT_TRUE(all.where.empty());
    EXPECT_TRUE(rule("wrong_pixels", "object = \"*\"").each_object);
    EXPECT_EQ(rule("wrong_pixels", "camera.eye = [3, 4.5, -7]").where.at("camera.eye"),
              "[3, 4.5, -7]");
    EXPECT_TRUE(rule("wrong_pixels", "zeta_band = \"*\"").each_band);
    EXPECT_EQ(rule("new_pixels", "zeta_band = [0, inf]").pixels.bands,
              (analysis::LightDistanceBands{{0}, {analysis::LightDistanceBand::highest}}));
    EXPECT_EQ(rule("new_pixels", "zeta_band = [-inf, -0.5]").pixels.bands,
              (analysis::LightDistanceBands{{analysis::LightDistanceBand::lowest},
                                            analysis::light_distance_band_of(-1)}));
}

TEST(GateRuleFile, RefusesPixelsThatCannotBeMeant)
{
    const auto refusal = [](const std::string& metric, const std::string& where) {
        return rule_refusal(fmt::format(
            "[[rule]]\nid = \"a\"\nmetric = \"{}\"\nmax = 0\nwhere = {{{}}}", metric, where));
    };
    EXPECT_THAT(refusal("false_lit", "cause = \"bais\""), HasSubstr("nearest: \"bias\""));
    EXPECT_THAT(refusal("false_lit", "label = \"none\""), HasSubstr("is not a label"));
    for (const char* const band : {"[4, 15]", "[16, 4]", "[4]", "4", "\"far\"", "[4, 4]",
                                   "[nan, 8]", "[-4, -8]", "[inf, inf]", "[\"4\", 8]"}) {
        EXPECT_THAT(refusal("false_lit", fmt::format("zeta_band = {}", band)),
                    HasSubstr("powers of two"))
            << band;
    }
    for (const auto& [metric, where] : std::vector<std::pair<std::string, std::string>>{
             {"labels.peter_panning", "label = \"acne\""},
             {"false_shadow", "label = \"peter_panning\""},
             {"wrong_pixels", "cause = \"bias\", label = \"acne\""},
             {"pixels.lit", "cause = \"bias\""},
             {"new_pixels", "cause = \"bias\", label = \"leak\""}}) {
        EXPECT_THAT(refusal(metric, where), HasSubstr("no pixel of " + metric)) << where;
    }
    EXPECT_THAT(refusal("map_bytes", "object = \"a\""), HasSubstr("is not counted by them"));
    EXPECT_THAT(refusal("new_pixels", "object = \"*\""), HasSubstr("name one"));
    EXPECT_THAT(refusal("false_lit", "object = \"*\""), HasSubstr("compares with the baseline"));
}

TEST(GateRuleFile, ReadsPointsOfTheCurve)
{
    const auto rules = parse_gate_rules(
        "[[rule]]\nid = \"a\"\nmetric = \"bias_curve.at(1e-3).false_lit\"\nallow_pixels = 2",
        "gate.toml");
    EXPECT_EQ(rules[0].metric, "bias_curve.at(0.001).false_lit");
}

} // namespace
} // namespace gnomon::reports
