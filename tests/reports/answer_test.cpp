#include "reports/text/answer.hpp"

#include "example_comparison.hpp"
#include "finding_case.hpp"
#include "reports/text/answer_lines.hpp"
#include "reports/text/tones.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Wrapped, BreaksBetweenWords)
{
    EXPECT_THAT(wrapped("a fine map", 10), ElementsAre("a fine map"));
    EXPECT_THAT(wrapped("a fine map", 9), ElementsAre("a fine", "map"));
    EXPECT_THAT(wrapped("a fine map", 1), ElementsAre("a", "fine", "map"));
}

TEST(Wrapped, KeepsANumberByItsUnitAndAKeyByItsValue)
{
    EXPECT_THAT(wrapped("up to 12 m.", 9), ElementsAre("up to", "12 m."));
    EXPECT_THAT(wrapped("set cull = 1 now", 10), ElementsAre("set", "cull = 1", "now"));
}

TEST(Wrapped, KeepsBlanksBeforeAComment)
{
    EXPECT_THAT(wrapped("a = 1  # m", 20), ElementsAre("a = 1  # m"));
}

TEST(Wrapped, IsOneEmptyLineForNothing)
{
    EXPECT_THAT(wrapped("", 10), ElementsAre(""));
}

TEST(AnswerLines, ContinueUnderTheText)
{
    AnswerLines lines{false};
    lines.entry("fix", std::string(60, 'a') + " " + std::string(60, 'b'), Tone::good);
    EXPECT_EQ(lines.text(), fmt::format("fix       {}\n          {}\n", std::string(60, 'a'),
                                        std::string(60, 'b')));
}

TEST(AnswerLines, HaveTonesInColourAlone)
{
    AnswerLines lines{true};
    lines.entry("fix", "this", Tone::good);
    lines.flagged("warning", "that", Tone::bad);
    EXPECT_EQ(lines.text(), "fix       \x1b[32mthis\x1b[0m\n\x1b[38;5;208mwarning   \x1b[0mthat\n");
}

/// 20 px of acne and 4 px of edges, and a bias that leaves one.
analysis::Comparison with_acne()
{
    analysis::Comparison comparison = comparison_of(20, 4);
    comparison.scene.name = "columns";
    set_causes(comparison, analysis::Cause::resolution, analysis::Label::acne);
    comparison.diagnosis->curve.recommended = recommended(0.375F, 1);
    comparison.diagnosis->curve.recommended->low = {0.25F, 1, 2};
    comparison.diagnosis->curve.recommended->high = {0.5F, 2, 4};
    return comparison;
}

TEST(Answer, SaysWhatIsWrongAndWhatMendsIt)
{
    EXPECT_THAT(
        answer_text(with_acne(), {false, "gnomon settings job.toml"}),
        AllOf(StartsWith("columns: 24.0 % of the lit surface shadows itself (acne).\n"
                         "wrong     24 of 200 scored pixels (12.0 %): 20 false shadow, 4 false "
                         "lit\n"
                         "fix       bias.constant = 0.375  # 1.5 m, 3 texels\n"
                         "          This leaves 0.500 % wrong, from 12.0 %. Biases from 1 to 2 m "
                         "are nearly as good."),
              HasSubstr("\ngnomon settings job.toml --engine NAME translates the fix.\n")));
}

TEST(Answer, ListsOtherWaysWithTheirMemory)
{
    analysis::Comparison comparison = with_acne();
    for (const int size : {2, 4, 8, 16, 32}) {
        comparison.advice.push_back(rerun(fmt::format("shadow_map.resolution = {}", size), {1, 1}));
    }
    const std::string answer = answer_text(comparison, {});
    EXPECT_THAT(answer, HasSubstr("\nor        "));
    EXPECT_THAT(answer, HasSubstr("shadow_map.resolution = 32: leaves 1.00 %, 4 MiB\n"))
        << "what was measured is listed whole";
}

TEST(Answer, NamesNoSettingsCommandWhereNoBiasIsRecommended)
{
    analysis::Comparison comparison = with_acne();
    comparison.diagnosis->curve.recommended.reset();
    EXPECT_THAT(answer_text(comparison, {false, "gnomon settings job.toml"}),
                AllOf(HasSubstr("\nfix       `--advise` measures what cures the errors.\n"),
                      Not(HasSubstr("--engine NAME"))));
}

TEST(Answer, KeepsALongCommandOnOneLine)
{
    const std::string command = "gnomon settings " + std::string(100, 'a') + " --set b=1";
    EXPECT_THAT(answer_text(with_acne(), {false, command}),
                HasSubstr("\n" + command + " --engine NAME translates the fix.\n"));
}

TEST(Answer, HasCountsAloneWithoutADiagnosis)
{
    analysis::Comparison comparison = comparison_of(20, 4);
    comparison.diagnosis.reset();
    comparison.scene.name = "yard";
    EXPECT_THAT(answer_text(comparison, {}),
                AllOf(StartsWith("yard: 12.0 % of the scored pixels are wrong.\nwrong     24 of "),
                      Not(HasSubstr("\nfix"))));
    comparison.metrics = make_metrics(comparison.metrics.pixels, {0, 0, {20, 0, 100, 0}});
    EXPECT_THAT(answer_text(comparison, {}),
                StartsWith("yard: no scored pixel is on the wrong side of one half, but verdicts "
                           "are off by 10.0 % on average.\n"));
}

TEST(Answer, NotesTheScene)
{
    analysis::Comparison comparison = with_acne();
    comparison.scene.notes = {{"alpha_mask", 2, "2 materials are cut out"}};
    EXPECT_THAT(answer_text(comparison, {}), HasSubstr("\nnote      2 materials are cut out.\n"));
}

TEST(Answer, WarnsWhereMuchIsNotScored)
{
    analysis::Comparison comparison = with_acne();
    analysis::ClassCounts& pixels = comparison.metrics.pixels;
    pixels.total = 400;
    pixels.by_class[static_cast<std::size_t>(scene::PixelClass::unmatched)] = 200;
    EXPECT_THAT(answer_text(comparison, {}),
                HasSubstr("\nwarning   50.0 % of the surface (200 pixels) is not scored: GL and "));
}

TEST(Answer, NamesThreeObjectsWithTheMostWrongPixels)
{
    analysis::Comparison comparison = with_acne();
    const auto add = [&](const std::string& name, std::uint64_t false_shadow) {
        comparison.diagnosis->by_object.push_back({name, {.false_shadow = false_shadow}});
    };
    add("one", 5);
    add("two", 0);
    add("three", 12);
    add("four", 1);
    add("five", 2);
    EXPECT_THAT(answer_text(comparison, {}),
                HasSubstr("\nlook at   three (12 px), one (5), five (2)\n"));
}

TEST(Answer, PointsToTheLargestPatch)
{
    const analysis::Comparison& comparison = store::example().comparison;
    EXPECT_THAT(answer_text(comparison, {}),
                HasSubstr("\nlook at   largest patch: 175 px around (62, 45) on ground\n"));
}

TEST(Answer, ColoursTheErrorTheFixAndTheRest)
{
    EXPECT_THAT(answer_text(with_acne(), {true}),
                AllOf(StartsWith("\x1b[38;5;208mcolumns: "),
                      HasSubstr("\x1b[32mbias.constant = 0.375  # 1.5 m, 3 texels\x1b[0m\n"),
                      HasSubstr("\x1b[2m--verbose")));
}

TEST(Answer, IsGreenWhereAllIsRight)
{
    analysis::Comparison comparison = comparison_of(0, 0);
    comparison.scene.name = "room";
    EXPECT_THAT(
        answer_text(comparison, {true}),
        StartsWith("\x1b[32mroom: all 200 scored pixels are right.\x1b[0m\n\x1b[2msettings"));
}

TEST(Answer, NeverHidesWarningsOfAnotherRenderersFrame)
{
    analysis::Comparison comparison = with_acne();
    comparison.evaluation.emplace();
    comparison.evaluation->case_name = "crate";
    comparison.evaluation->import_check.warning = "the mask shows no cast shadow";
    comparison.evaluation->contradicted_pixels = 3;
    comparison.evaluation->cannot_know = {{"the bias curve", "z.map"}};
    EXPECT_THAT(answer_text(comparison, {}),
                AllOf(StartsWith("crate: "), HasSubstr("\nmesh      99 % of the positions"),
                      HasSubstr("\nwarning   The mask shows no cast shadow.\n"),
                      HasSubstr("\nwarning   The mask contradicts its own lookup at 3 scored "),
                      HasSubstr("\nunknown   The bias curve; needs z.map.\n")));
}

TEST(Answer, SumsUpSeveralLights)
{
    const std::vector<std::string> names{"sun", "lamp"};
    std::vector<analysis::Comparison> lights(2, with_acne());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].light = names[i];
    }
    EXPECT_THAT(answer_text(lights, {}),
                AllOf(StartsWith("columns, light sun: "), HasSubstr("\n\ncolumns, light lamp: "),
                      HasSubstr("\nAll lights: 48 of 400 scored pixels (12.0 %): 40 false shadow, "
                                "8 false lit.\n")));
}

} // namespace
} // namespace gnomon::reports
