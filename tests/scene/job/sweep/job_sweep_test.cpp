// `[sweep]`: its axes and how they are combined.

#include "job_fixture.hpp"

#include <cmath>

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string scene = "scene.builtin = \"wall\"\n[sweep]\n";

Sweep sweep_of(const std::string& lines)
{
    return job_of(scene + lines).sweep;
}

TEST(Sweep, IsAProductOfNoAxesByDefault)
{
    const Sweep sweep = job_of("scene.builtin = \"wall\"").sweep;
    EXPECT_TRUE(sweep.axes.empty());
    EXPECT_EQ(sweep.mode, "product");
    EXPECT_EQ(sweep.sample, 0);
    EXPECT_EQ(sweep.seed, 0);
}

TEST(Sweep, KeepsItsAxesInTheOrderOfTheFile)
{
    const Sweep sweep = sweep_of("\"shadow_map.resolution\" = [512, 1024]\n"
                                 "\"bias.constant\" = [0.0, 1e-3, 1]\n"
                                 "lookup.filter = [\"pcf3\", \"nearest\"]\n"
                                 "\"light.direction\" = [[0, -1, 0], [1, -1, 0.5]]\n"
                                 "mode = \"product\"\nsample = 12\nseed = 7\n");
    ASSERT_EQ(sweep.axes.size(), 4U);
    EXPECT_EQ(sweep.axes[0].key, "shadow_map.resolution");
    EXPECT_THAT(sweep.axes[0].values, ElementsAre("512", "1024"));
    EXPECT_THAT(sweep.axes[1].values, ElementsAre("0", "0.001", "1"));
    EXPECT_THAT(sweep.axes[2].values, ElementsAre("\"pcf3\"", "\"nearest\""));
    EXPECT_THAT(sweep.axes[3].values, ElementsAre("[0, -1, 0]", "[1, -1, 0.5]"));
    EXPECT_EQ(sweep.sample, 12);
    EXPECT_EQ(sweep.seed, 7);
}

TEST(Sweep, ExpandsLinearRangesToEquallySpacedValues)
{
    const Sweep sweep = sweep_of("\"bias.slope\" = {from = 0, to = 1, count = 5}\n"
                                 "\"bias.constant\" = {from = 0.3, to = -0.1, count = 3}\n");
    EXPECT_THAT(sweep.axes[0].values, ElementsAre("0", "0.25", "0.5", "0.75", "1"));
    // Downwards, too; both ends are exactly those of the file.
    EXPECT_EQ(sweep.axes[1].values.front(), "0.3");
    EXPECT_EQ(sweep.axes[1].values.back(), "-0.1");
}

TEST(Sweep, ExpandsLogarithmicRangesToEqualRatios)
{
    const Sweep sweep = sweep_of(
        "\"bias.constant\" = {from = 1e-6, to = 1e-1, count = 200, scale = \"log\"}\n"
        "\"shadow_map.resolution\" = {from = 256, to = 8192, count = 6, scale = \"log\"}\n");
    const auto& values = sweep.axes[0].values;
    ASSERT_EQ(values.size(), 200U);
    EXPECT_EQ(values.front(), "1e-06");
    EXPECT_EQ(values.back(), "0.1");
    for (std::size_t i = 1; i < values.size(); ++i) {
        // 1e-12: log10, a product, a quotient and pow each round at 2^-53, magnified by |ln| < 14.
        EXPECT_NEAR(std::stod(values[i]) / std::stod(values[i - 1]), std::pow(10, 5.0 / 199),
                    1e-12);
    }
    EXPECT_THAT(sweep.axes[1].values, ElementsAre("256", "512", "1024", "2048", "4096", "8192"));
}

TEST(Sweep, EndsLogarithmicRangesAtTheVeryNumbersOfTheFile)
{
    // In double, 10^log10(0.9) is less than 0.9, and 10^log10(0.003) is not 0.003.
    const auto values =
        sweep_of("\"bias.slope\" = {from = 0.003, to = 0.9, count = 5, scale = \"log\"}\n")
            .axes[0]
            .values;
    EXPECT_EQ(values.front(), "0.003");
    EXPECT_EQ(values.back(), "0.9");
}

TEST(Sweep, HoldsEveryValueAgainstItsKey)
{
    EXPECT_EQ(refusal(scene + "\"shadow_map.resolution\" = [512, 0]\n"),
              "job.toml:3: [sweep] shadow_map.resolution = 0: must be an integer from 1 to 16384");
    EXPECT_THAT(refusal(scene + "\"lookup.filter\" = [\"pcf3\", \"pcf4\"]\n"),
                HasSubstr("[sweep] lookup.filter = \"pcf4\": must be one of nearest, linear"));
    EXPECT_THAT(
        refusal(scene + "\"bias.constant\" = {from = 0, to = 2, count = 3}\n"),
        HasSubstr("job.toml:3: [sweep] bias.constant, to = 2: must be a number from -1 to "));
    // Neither end is subnormal, but a value between is.
    EXPECT_THAT(refusal(scene + "\"bias.slope\" = {from = 0, to = 2e-38, count = 9}\n"),
                HasSubstr("[sweep] bias.slope = 2.5e-39: must be a number"));
}

TEST(Sweep, RefusesRangesThatAreNone)
{
    const std::vector<std::pair<std::string, std::string>> cases{
        {"{from = 0, to = 1}", "\"count\" is missing"},
        {"{to = 1, count = 3}", "\"from\" is missing"},
        {"{from = 0, to = 1, count = 1}", "count = 1: must be an integer from 2 to 100000"},
        {"{from = 0, to = 1, count = 100001}", "must be an integer from 2 to 100000"},
        {"{from = 0, to = 1, count = 2.5}", "must be an integer from 2 to 100000"},
        {"{from = 0, to = 1, count = 3, scale = \"log\"}", "must be above 0"},
        {"{from = 0, to = 1, count = 3, scale = \"linaer\"}", "the nearest is \"linear\""},
        {"{from = 0, to = 1, cuont = 3}", "unknown key \"cuont\"; the nearest is count"},
        {"{from = 0.5, to = 0.5, count = 3}", "from and to must differ"},
        {"[]", "must be a list of values, or {from, to, count, scale}"},
        {"0.5", "must be a list of values, or {from, to, count, scale}"},
    };
    for (const auto& [value, expected] : cases) {
        const std::string message = refusal(scene + "\"bias.constant\" = " + value + "\n");
        EXPECT_THAT(message, HasSubstr(expected));
        EXPECT_THAT(message, HasSubstr("job.toml:3: [sweep] bias.constant"));
    }
}

TEST(Sweep, RefusesRangesOfWordsAndIntegersThatComeTwice)
{
    EXPECT_THAT(refusal(scene + "\"shadow_map.near\" = {from = \"auto\", to = 1, count = 3}\n"),
                HasSubstr("only numbers have a range"));
    EXPECT_THAT(refusal(scene + "\"shadow_map.resolution\" = {from = 1, to = 3, count = 9}\n"),
                HasSubstr("comes twice; lower the count"));
}

TEST(Sweep, RefusesUnknownKeysNamingTheNearest)
{
    EXPECT_EQ(refusal(scene + "\"bias.constnt\" = [0]\n"),
              "job.toml:3: unknown key \"bias.constnt\"; the nearest is bias.constant");
    EXPECT_EQ(refusal(scene + "mod = \"zip\"\n"),
              "job.toml:3: unknown key \"mod\"; the nearest is mode");
    EXPECT_THAT(refusal(scene + "mode = \"zap\"\n"), HasSubstr("the nearest is \"zip\""));
    EXPECT_THAT(refusal(scene + "sample = -1\n"), HasSubstr("an integer from 0 to 1000000000"));
    EXPECT_THAT(refusal(scene + "seed = 1.5\n"), HasSubstr("[sweep] seed = 1.5: must be"));
    EXPECT_EQ(refusal("sweep = 3\n"), "job.toml:1: sweep: must be a table, [sweep]");
}

TEST(Sweep, RefusesAnAxisGivenTwice)
{
    EXPECT_EQ(refusal(scene + "\"bias.slope\" = [0]\nbias.slope = [1]\n"),
              "job.toml:4: [sweep] bias.slope: the axis is given twice; keep one");
}

TEST(Sweep, ZipsOnlyAxesOfOneLength)
{
    const std::string axes = "mode = \"zip\"\n\"bias.slope\" = [0, 1]\n\"bias.constant\" = ";
    EXPECT_EQ(sweep_of(axes + "[0, 0]\n").axes[1].values.size(), 2U);
    EXPECT_EQ(refusal(scene + axes + "[0, 0.5, 1]\n"),
              "job.toml: [sweep] mode = \"zip\": axes must be equally long, but bias.slope has 2 "
              "values and bias.constant has 3");
}

} // namespace
} // namespace gnomon::scene::test
