// The short answer of `gnomon compare`, and what it prints besides.

#include "child_process.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> comparison_of(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), {"compare", "--builtin"});
    return small(arguments);
}

std::string answer_of(const std::vector<std::string>& arguments)
{
    const Ending ending = gnomon(comparison_of(arguments));
    expect_done(ending);
    return ending.out;
}

TEST(Answer, NamesTheErrorTheFixAndTheNextCommands)
{
    const std::string answer = answer_of({"columns"});
    EXPECT_THAT(answer, StartsWith("columns: 0."));
    for (const char* const part :
         {" of the lit surface shadows itself (acne)", "\nwrong     ", " scored pixels (",
          " false shadow, ", "\nfix       bias.constant_m = 0.0", " texels\n          This leaves ",
          " % wrong, from ", " m are nearly as good. A caster", "\nlook at   ",
          "largest patch: ", "\nsettings  map 2048x2048 d24, fit scene; nearest; bias constant ",
          "\n--verbose shows every number; --picture FILE.png draws it"}) {
        EXPECT_THAT(answer, HasSubstr(part));
    }
    EXPECT_THAT(answer, EndsWith(" --engine NAME translates the fix.\n"));
}

TEST(Answer, HasAtMostSixteenLinesOfAHundredAndTenColumns)
{
    for (const char* const builtin : {"columns", "yard", "wall", "room", "lamp-room", "fence"}) {
        const std::vector<std::string> lines = lines_of(answer_of({builtin}));
        EXPECT_LE(lines.size(), 16U) << builtin;
        for (const std::string& line : lines) {
            // A command to paste is not broken.
            EXPECT_TRUE(line.size() <= 110 || line.starts_with("gnomon settings ")) << line;
        }
    }
}

TEST(Answer, NamesPeterPanning)
{
    EXPECT_THAT(answer_of({"yard", "--set", "bias.constant=0.1"}),
                AllOf(StartsWith("yard: 99."), HasSubstr("(peter-panning)"),
                      HasSubstr("0 false shadow, ")));
}

TEST(Answer, IsShortWhereNothingIsWrong)
{
    const std::vector<std::string> lines = lines_of(answer_of({"room"}));
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_THAT(lines[0], MatchesRegex("room: all [0-9,]+ scored pixels are right\\."));
    EXPECT_THAT(lines[1], StartsWith("settings  "));
    EXPECT_EQ(lines[2], "--verbose shows every number; --picture FILE.png draws it.");
}

TEST(Answer, CountsWithoutCausesWhereTheTruthIsFloat)
{
    EXPECT_THAT(answer_of({"columns", "--truth", "float"}),
                AllOf(StartsWith("columns: "), HasSubstr(" of the scored pixels are wrong.\n"),
                      HasSubstr("\nnote      Causes and a fix need the exact truth"),
                      Not(HasSubstr("\nfix"))));
}

TEST(Answer, HasWhatWasAskedFor)
{
    EXPECT_THAT(answer_of({"wall", "--audit"}), HasSubstr("\naudit     no_offset: wrong at "));
    EXPECT_THAT(answer_of({"wall", "--verify"}), HasSubstr("\nverified  "));
    EXPECT_THAT(answer_of({"sphere-plane", "--advise"}),
                AllOf(HasSubstr("\nor        "), HasSubstr(": leaves ")));
}

TEST(Answer, OfSeveralLightsEndsWithTheirTotals)
{
    const std::vector<std::string> arguments =
        small({"compare", GNOMON_ROOT "/examples/lights.toml"});
    const Ending ending = gnomon(arguments);
    expect_done(ending);
    for (const char* const name : {"sun", "torch", "lamp"}) {
        EXPECT_THAT(ending.out, HasSubstr(fmt::format("columns, light {}: ", name)));
    }
    std::vector<std::string> as_json = arguments;
    as_json.emplace_back("--json");
    const auto all = nlohmann::json::parse(gnomon(as_json).out);
    const auto wrong =
        all.at("false_shadow").get<std::uint64_t>() + all.at("false_lit").get<std::uint64_t>();
    EXPECT_THAT(ending.out,
                HasSubstr(fmt::format("\n\nAll lights: {} of ", scene::grouped(wrong))));
}

TEST(Answer, GivesWayToTheTable)
{
    const std::string table = answer_of({"wall", "--verbose"});
    EXPECT_THAT(table, StartsWith("scene           wall\n"));
    EXPECT_THAT(table, Not(HasSubstr("--verbose")));
}

/// What the program prints on a terminal with these variables set: "TERM=xterm NO_COLOR=".
std::string on_a_terminal(const std::string& variables)
{
    const std::string program = gnomon({"--version"}).command;
    const std::string command =
        fmt::format("{} {} compare --builtin wall --set image.width=64 --set image.height=36",
                    variables, program.substr(0, program.find(' ')));
    const Ending ending = run({"script", "-qec", command, "/dev/null"});
    EXPECT_EQ(ending.exit_code, 0) << ending.out;
    return ending.out;
}

TEST(AnswerColours, AreForTerminalsAlone)
{
    EXPECT_THAT(answer_of({"wall"}), Not(HasSubstr("\x1b")));
    if (run({"script", "-qec", "true", "/dev/null"}).exit_code != 0) {
        GTEST_SKIP() << "no `script`, or no terminal that it could give";
    }
    EXPECT_THAT(on_a_terminal("TERM=xterm NO_COLOR="),
                AllOf(HasSubstr("\x1b[38;5;208mwall: "), HasSubstr("fix       \x1b[32mbias."),
                      HasSubstr("\x1b[2m--verbose")));
    for (const char* const variables : {"TERM=dumb NO_COLOR=", "TERM=xterm NO_COLOR=1"}) {
        EXPECT_THAT(on_a_terminal(variables), AllOf(HasSubstr("wall: "), Not(HasSubstr("\x1b["))));
    }
}

TEST(OutputFiles, AreNamedOnStandardError)
{
    const TemporaryFolder folder;
    const std::string place = folder.path();
    const Ending ending = gnomon(comparison_of(
        {"wall", "--aov", place + "/a.exr", "--picture", place + "/p.png", "--depth-map",
         place + "/d.exr", "--heat-map", "cause=" + place + "/c.png", "--view-depths",
         place + "/v.csv", "--export-case", place + "/case", "--out", place + "/run"}));
    EXPECT_EQ(ending.exit_code, 0);
    std::vector<std::string> lines = lines_of(ending.err);
    std::sort(lines.begin(), lines.end());
    std::vector<std::string> named;
    for (const char* const name : {"a.exr", "c.png", "case", "d.exr", "p.png", "run", "v.csv"}) {
        named.push_back(fmt::format("gnomon compare: wrote {}/{}", place, name));
    }
    EXPECT_EQ(lines, named);
    const Ending evaluated = gnomon({"evaluate", place + "/case", "--picture", place + "/e.png"});
    EXPECT_EQ(evaluated.err, fmt::format("gnomon evaluate: wrote {}/e.png\n", place));
}

TEST(CompareEngine, PrintsTheRecommendedSettingsToo)
{
    EXPECT_THAT(answer_of({"columns", "--engine", "three"}),
                AllOf(StartsWith("columns: "), HasSubstr("draws it.\n\nthree.js, with the "),
                      HasSubstr("light.shadow.bias = "), Not(HasSubstr("gnomon settings"))));
}

TEST(CompareEngine, NotesALightThatTheEngineDoesNotSupport)
{
    const Ending ending = gnomon(comparison_of({"sphere-plane", "--engine", "unity"}));
    EXPECT_EQ(ending.exit_code, 0);
    EXPECT_THAT(ending.out, EndsWith("draws it.\n"));
    EXPECT_EQ(ending.err, "gnomon compare: note: Unity URP: Gnomon does not know its settings for "
                          "a spot light\n");
}

TEST(CompareEngine, RefusesWhatHasNoPlaceForIt)
{
    expect_refused(gnomon(comparison_of({"wall", "--engine", "thre"})), 2,
                   "--engine thre: unknown engine; the nearest is three");
    expect_refused(gnomon(comparison_of({"wall", "--engine", "three", "--json"})), 2,
                   "`gnomon settings --json`");
    expect_refused(gnomon(comparison_of({"wall", "--engine", "three", "--truth", "float"})), 2,
                   "--engine needs --truth exact");
}

TEST(TuneEngine, PrintsWhatWasFound)
{
    const std::vector<std::string> tune =
        small({"tune", "--builtin", "wall", "--max-resolution", "256", "--engine", "three"});
    EXPECT_THAT(gnomon(tune).out, AllOf(HasSubstr("\n\nthree.js, with the recommended bias:\n"),
                                        HasSubstr("light.shadow.mapSize.set(")));
    std::vector<std::string> as_json = tune;
    as_json.emplace_back("--json");
    expect_refused(gnomon(as_json), 2, "`gnomon settings --json`");
}

} // namespace
} // namespace gnomon::testing
