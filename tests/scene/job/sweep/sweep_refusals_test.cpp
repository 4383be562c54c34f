// Axes of the command line, and invalid sweeps.

#include "job_fixture.hpp"

#include <fmt/format.h>

#include <random>

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> axis_values(const std::string& argument)
{
    return space_of(wall, {argument}).axes().at(0).values;
}

TEST(SweepAxes, AreReadFromTheCommandLine)
{
    EXPECT_THAT(axis_values("shadow_map.resolution=512,1024,2048"),
                ElementsAre("512", "1024", "2048"));
    EXPECT_THAT(axis_values("shadow_map.resolution=512"), ElementsAre("512"));
    EXPECT_THAT(axis_values("shadow_map.resolution=[512, 1024]"), ElementsAre("512", "1024"));
    EXPECT_THAT(axis_values("lookup.filter=pcf3, nearest ,linear"),
                ElementsAre("\"pcf3\"", "\"nearest\"", "\"linear\""));
    EXPECT_THAT(axis_values("lookup.filter=[pcf3, nearest]"),
                ElementsAre("\"pcf3\"", "\"nearest\""));
    EXPECT_THAT(axis_values("lookup.filter=[\"pcf3\", 'nearest']"),
                ElementsAre("\"pcf3\"", "\"nearest\""));
    EXPECT_THAT(axis_values("shadow_map.near=auto,0.5"), ElementsAre("\"auto\"", "0.5"));
    EXPECT_THAT(axis_values("shadow_map.reversed=true,false"), ElementsAre("true", "false"));
    EXPECT_THAT(axis_values("bias.slope={from = 0, to = 1, count = 3}"),
                ElementsAre("0", "0.5", "1"));
    EXPECT_THAT(axis_values("bias.slope={from=1, to=100, count=3, scale=\"log\"}"),
                ElementsAre("1", "10", "100"));
}

TEST(SweepAxes, KeepCommasInsideValues)
{
    EXPECT_THAT(axis_values("light.direction=[[0, -1, 0], [1, -1, 0.5]]"),
                ElementsAre("[0, -1, 0]", "[1, -1, 0.5]"));
    EXPECT_THAT(axis_values("light.direction=[0, -1, 0], [1, -1, 0.5]"),
                ElementsAre("[0, -1, 0]", "[1, -1, 0.5]"));
    EXPECT_THAT(axis_values("scene.no_cast=[\"a,b\"],[],[\"c\", 'd]']"),
                ElementsAre("[\"a,b\"]", "[]", "[\"c\", \"d]\"]"));
    EXPECT_THAT(axis_values("scene.file=\"a,b.obj\",c.obj"),
                ElementsAre("\"a,b.obj\"", "\"c.obj\""));
}

TEST(SweepSpace, RefusesAnAxisThatIsSetOtherwiseToo)
{
    EXPECT_EQ(
        space_refusal(wall + "[sweep]\n\"bias.slope\" = [0, 1]\n", {}, {}, {{"bias.slope", "3"}}),
        "--set bias.slope: bias.slope is an axis of the sweep; give its values with --axis "
        "bias.slope=…, or remove one of the two");
    EXPECT_EQ(space_refusal(wall + "[sweep]\n\"bias.slope\" = [0, 1]\n[[case]]\nname = \"a\"\n"
                                   "bias.slope = 2\n"),
              "job.toml: [[case]] \"a\": bias.slope is an axis of the sweep too; remove it from "
              "the case or from the axes");
    EXPECT_EQ(space_refusal(wall, {"bias.slope=1", "bias.slope=2"}),
              "--axis bias.slope: the axis is given twice; keep one");
}

TEST(SweepSpace, RefusesValuesThatComeTwice)
{
    EXPECT_EQ(space_refusal(wall + "[sweep]\n\"bias.slope\" = [0, 1, 0.0]\n"),
              "job.toml: [sweep] bias.slope: 0 comes twice; keep one");
    EXPECT_EQ(space_refusal(wall + "[sweep]\nmode = \"zip\"\n\"bias.slope\" = [0, 1, 0]\n"
                                   "\"bias.constant\" = [0, 0, 0]\n"),
              "job.toml: [sweep] mode = \"zip\": the 3. values of all axes are those of an "
              "earlier one; keep one");
}

TEST(SweepSpace, RefusesMoreConfigurationsThanAnybodyReads)
{
    const std::string axes = "\"bias.slope\" = {from = 1, to = 2, count = 5000}\n"
                             "\"bias.constant\" = {from = 0.5, to = 1, count = 2001}\n";
    EXPECT_EQ(space_refusal(wall + "[sweep]\n" + axes),
              "job.toml: [sweep]: more than 10000000 configurations; shorten the axes, or draw "
              "some of them with sample = N");
    EXPECT_THAT(space_refusal(wall + "[sweep]\nsample = 10000001\n" + axes),
                HasSubstr("more than 10000000 configurations"));
    EXPECT_EQ(space_of(wall + "[sweep]\nsample = 10\n" + axes).size(), 10U);
    std::string text = wall + "[sweep]\nsample = 10\n";
    for (const char* const key : {"bias.slope", "bias.normal_texels", "shadow_map.roll_deg",
                                  "shadow_map.near", "shadow_map.far"}) {
        text += fmt::format("\"{}\" = {{from = 1, to = 2, count = 10000}}\n", key);
    }
    EXPECT_EQ(space_refusal(text), "job.toml: [sweep]: 2^64 configurations or more, too many even "
                                   "to sample; shorten the axes");
    EXPECT_THAT(space_refusal(text, {"camera.vertical_fov_deg={from = 1, to = 2, count = 50001}"}),
                HasSubstr("[sweep] camera.vertical_fov_deg: more than 100000 values on all axes"));
}

TEST(SweepSpace, RefusesZippedAxesOfUnequalLengths)
{
    EXPECT_EQ(space_refusal(wall + "[sweep]\nmode = \"zip\"\n\"bias.slope\" = [0, 1]\n",
                            {"bias.constant=0,0.5,1"}),
              "job.toml: [sweep] mode = \"zip\": axes must be equally long, but bias.slope has 2 "
              "values and bias.constant has 3");
}

TEST(SweepAxes, AreRefusedWhenTheyAreNone)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"bias.slope", "write KEY=VALUES"},
        {"=1,2", "write KEY=VALUES"},
        {"bias.slpe=1", "unknown key \"bias.slpe\"; the nearest is bias.slope"},
        {"bias.slope=", "write a list"},
        {"bias.slope=1,,2", "write a list"},
        {"bias.slope=[]", "must be a list of values, or {from, to, count, scale}"},
        {"bias.slope=one", "--axis bias.slope = \"one\": must be a number"},
        {"bias.slope={from = 0, to = 1}", "\"count\" is missing"},
        {"bias.slope={from = 0, to = 1, count = 2", "write a list"},
        {"bias.slope=[1, 2", "write a list"},
        {"shadow_map.resolution=0", "must be an integer from 1 to 16384"},
        {"lookup.filter=pcf4", "must be one of"},
        {"light.direction=[0, -1, 0]", "--axis light.direction = 0: must be three numbers"}};
    for (const auto& [argument, expected] : cases) {
        const std::string message = space_refusal(wall, {argument});
        EXPECT_THAT(message,
                    testing::StartsWith("--axis " + argument.substr(0, argument.find('='))));
        EXPECT_THAT(message, HasSubstr(expected)) << argument;
        EXPECT_EQ(message.find('\n'), std::string::npos) << argument;
    }
}

TEST(SweepAxes, MayBeAnyText)
{
    const std::vector<std::string> pieces{"bias.slope=",
                                          "light.direction=",
                                          "scene.no_cast=",
                                          "lookup.filter=",
                                          "shadow_map.near=",
                                          "bias.",
                                          "[",
                                          "]",
                                          "{",
                                          "}",
                                          ",",
                                          "=",
                                          "\"",
                                          "'",
                                          "\\",
                                          "from=0",
                                          "to=1",
                                          "count=3",
                                          "scale=\"log\"",
                                          "nan",
                                          "inf",
                                          "1e-320",
                                          "-1e400",
                                          "pcf3",
                                          "auto",
                                          "0x7fffffffffffffffffff",
                                          "1979-05-27",
                                          "\n",
                                          "#",
                                          "\x1b[31m",
                                          "\xff",
                                          "\"\"\"",
                                          "[[",
                                          "]]",
                                          " "};
    std::mt19937 random{13};
    const JobSource source = builtin_job_source("wall", {});
    for (int round = 0; round < 8'000; ++round) {
        std::string argument = random() % 4 == 0 ? "" : pieces[random() % 5];
        for (std::size_t i = random() % 9; i-- > 0;) {
            argument += random() % 8 == 0 ? std::string(1, static_cast<char>(random() % 256))
                                          : pieces[random() % pieces.size()];
        }
        // Without an InputError it was accepted; any other exception fails the test.
        const std::string message = error_of([&] { return SweepSpace{source, {argument}}.size(); });
        EXPECT_TRUE(std::all_of(message.begin(), message.end(),
                                [](unsigned char c) { return c >= 0x20 && c != 0x7F; }))
            << testing::PrintToString(argument) << " gives " << testing::PrintToString(message);
    }
    for (const std::string& deep : {std::string(100'000, '['), std::string(100'000, '{')}) {
        EXPECT_NE(error_of([&] {
                      return SweepSpace{source, {"bias.slope=" + deep}}.size();
                  }),
                  "no error");
    }
}

} // namespace
} // namespace gnomon::scene::test
