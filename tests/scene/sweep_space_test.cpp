// The configurations that a job's cases and axes span.

#include "scene/sweep_space.hpp"

#include "job_fixture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numeric>
#include <random>
#include <set>

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string wall = "scene.builtin = \"wall\"\n";

SweepSpace space_of(const std::string& text, const std::vector<std::string>& axes = {},
                    std::string_view case_name = {}, const std::vector<Override>& overrides = {})
{
    return {read_job_source(write_job(text), overrides), axes, case_name};
}

/// What a point says: its case and its values as the axes write them.
std::string words(const SweepSpace& space, const SweepPoint& point)
{
    std::string text{space.case_name(point)};
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        text += text.empty() ? "" : " ";
        text += space.axes()[i].values[point.values[i]];
    }
    return text;
}

std::vector<std::string> all_words(const SweepSpace& space)
{
    std::vector<std::string> all;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        all.push_back(words(space, space.at(i)));
    }
    return all;
}

/// The message with which a space is refused; the folder's name is taken off.
std::string space_refusal(const std::string& text, const std::vector<std::string>& axes = {},
                          std::string_view case_name = {},
                          const std::vector<Override>& overrides = {})
{
    std::string message = error_of([&] { return space_of(text, axes, case_name, overrides); });
    const std::string prefix = job_folder().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
        message.erase(at, prefix.size());
    }
    return message;
}

std::vector<std::string> axis_values(const std::string& argument)
{
    return space_of(wall, {argument}).axes().at(0).values;
}

TEST(SweepSpace, WithoutAxesIsTheJobItself)
{
    const SweepSpace space = space_of(wall + "bias.constant = 0.25\n");
    EXPECT_EQ(space.size(), 1U);
    EXPECT_EQ(space.case_count(), 0U);
    EXPECT_THAT(space.at(0).values, IsEmpty());
    EXPECT_EQ(space.case_name(space.at(0)), "");
    EXPECT_EQ(space.job(space.at(0)).bias.constant, 0.25);
}

TEST(SweepSpace, VariesCasesSlowestAndTheLastAxisFastest)
{
    const SweepSpace space = space_of(wall + "[sweep]\n\"shadow_map.resolution\" = [64, 128]\n"
                                             "\"bias.slope\" = [0, 1, 2]\n"
                                             "[[case]]\nname = \"noon\"\n"
                                             "[[case]]\nname = \"dusk\"\n");
    EXPECT_THAT(all_words(space),
                ElementsAre("noon 64 0", "noon 64 1", "noon 64 2", "noon 128 0", "noon 128 1",
                            "noon 128 2", "dusk 64 0", "dusk 64 1", "dusk 64 2", "dusk 128 0",
                            "dusk 128 1", "dusk 128 2"));
}

TEST(SweepSpace, MovesZippedAxesTogether)
{
    const SweepSpace space =
        space_of(wall + "[sweep]\nmode = \"zip\"\n\"shadow_map.resolution\" = [64, 128, 64]\n"
                        "\"bias.slope\" = [0, 1, 2]\n"
                        "[[case]]\nname = \"noon\"\n[[case]]\nname = \"dusk\"\n");
    EXPECT_EQ(space.mode(), "zip");
    EXPECT_THAT(all_words(space), ElementsAre("noon 64 0", "noon 128 1", "noon 64 2", "dusk 64 0",
                                              "dusk 128 1", "dusk 64 2"));
}

TEST(SweepSpace, DrawsTheSameSampleEverywhere)
{
    // The numbers are those of Floyd's algorithm over MT19937-64, written a second time in another
    // language.
    const std::string axes = "\"image.width\" = {from = 1, to = 1000, count = 1000}\n"
                             "\"image.height\" = {from = 1, to = 100, count = 100}\n";
    const auto drawn = [&](const std::string& options) {
        const SweepSpace space = space_of(wall + "[sweep]\n" + axes + options);
        std::vector<std::size_t> numbers;
        for (std::uint64_t i = 0; i < space.size(); ++i) {
            const SweepPoint point = space.at(i);
            numbers.push_back(point.values[0] * 100 + point.values[1]);
        }
        return numbers;
    };
    EXPECT_THAT(drawn("sample = 6\n"), ElementsAre(6626, 31918, 34391, 40974, 53533, 73450));
    EXPECT_THAT(drawn("sample = 6\nseed = 1\n"),
                ElementsAre(6409, 6630, 28784, 39636, 68028, 89845));
}

TEST(SweepSpace, DrawsFromSpacesThatNobodyCouldRun)
{
    // 20,000⁴ configurations; the expected numbers are found as above.
    std::string text = wall + "[sweep]\nsample = 3\nseed = 3\n";
    for (const char* const key :
         {"bias.slope", "bias.constant", "bias.normal_texels", "shadow_map.roll_deg"}) {
        text += fmt::format("\"{}\" = {{from = 0.125, to = 1, count = 20000}}\n", key);
    }
    const SweepSpace space = space_of(text);
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        const SweepPoint point = space.at(i);
        numbers.push_back(std::accumulate(
            point.values.begin(), point.values.end(), std::uint64_t{0},
            [](std::uint64_t sum, std::size_t value) { return sum * 20'000 + value; }));
    }
    EXPECT_THAT(numbers, ElementsAre(8029678232491475U, 67413207671831595U, 91203882987592189U));
    EXPECT_EQ(space.at(0).case_index, 0U);
}

TEST(SweepSpace, KeepsEverythingWhenTheSampleIsNotSmaller)
{
    for (const int sample : {0, 3, 4}) {
        const SweepSpace space = space_of(
            wall + fmt::format("[sweep]\nsample = {}\n\"bias.slope\" = [2, 1, 0]\n", sample));
        EXPECT_THAT(all_words(space), ElementsAre("2", "1", "0")) << sample;
    }
}

TEST(SweepSpace, DrawsWithoutReplacementInAscendingOrder)
{
    for (int seed = 0; seed < 50; ++seed) {
        const int count = 1 + seed % 12;
        const SweepSpace space = space_of(
            wall + fmt::format("[sweep]\nsample = {}\nseed = {}\n"
                               "\"bias.slope\" = [0, 1, 2, 3]\n\"bias.constant\" = [0, 0.5, 1]\n",
                               count, seed));
        ASSERT_EQ(space.size(), static_cast<std::uint64_t>(count)) << "seed " << seed;
        for (std::uint64_t i = 1; i < space.size(); ++i) {
            EXPECT_LT(space.at(i - 1).values, space.at(i).values) << "seed " << seed;
        }
    }
}

TEST(SweepSpace, RunsOneCaseAlone)
{
    const std::string text = wall + "[sweep]\n\"bias.slope\" = [0, 1]\n"
                                    "[[case]]\nname = \"noon\"\nbias.constant = 0.5\n"
                                    "[[case]]\nname = \"dusk\"\nbias.constant = 0.75\n";
    const SweepSpace space = space_of(text, {}, "dusk");
    EXPECT_EQ(space.case_count(), 1U);
    EXPECT_THAT(all_words(space), ElementsAre("dusk 0", "dusk 1"));
    EXPECT_EQ(space.job(space.at(1)).bias.constant, 0.75);
    EXPECT_THAT(space_refusal(text, {}, "dask"), HasSubstr("the nearest is \"dusk\""));
    EXPECT_THAT(space_refusal(wall, {}, "dusk"), HasSubstr("it has no [[case]] at all"));
}

TEST(SweepSpace, LaysFileCaseOverridesAndAxesOverEachOther)
{
    const SweepSpace space =
        space_of(wall + "shadow_map.resolution = 64\nlookup.filter = \"linear\"\nbias.slope = 1\n"
                        "bias.constant = 0.125\n"
                        "[sweep]\n\"bias.slope\" = [4]\n"
                        "[[case]]\nname = \"a\"\nlookup.filter = \"pcf3\"\nbias.constant = 0.25\n",
                 {}, {}, {{"bias.constant", "0.5"}});
    const auto keys = keys_of(space.job(space.at(0)));
    EXPECT_EQ(keys.at("shadow_map.resolution"), "64");
    EXPECT_EQ(keys.at("lookup.filter"), "\"pcf3\"");
    EXPECT_EQ(keys.at("bias.constant"), "0.5");
    EXPECT_EQ(keys.at("bias.slope"), "4");
}

TEST(SweepSpace, ReadsAxesFromTheCommandLine)
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

TEST(SweepSpace, ReadsCommasInsideValues)
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

TEST(SweepSpace, ReplacesTheFilesAxisInItsPlace)
{
    const std::string text = wall + "[sweep]\n\"bias.slope\" = [0, 1]\n\"bias.constant\" = [0]\n";
    const SweepSpace space = space_of(text, {"bias.slope=5,6,7", "shadow_map.resolution=64"});
    ASSERT_EQ(space.axes().size(), 3U);
    EXPECT_EQ(space.axes()[0].key, "bias.slope");
    EXPECT_THAT(space.axes()[0].values, ElementsAre("5", "6", "7"));
    EXPECT_EQ(space.axes()[2].key, "shadow_map.resolution");
    EXPECT_EQ(space.size(), 3U);
}

TEST(SweepSpace, SharesAStructureIffOnlyConstantBiasesDiffer)
{
    const SweepSpace space = space_of(wall + "[sweep]\n\"bias.slope\" = [0, 1]\n"
                                             "\"bias.constant\" = [0, 0.5]\n"
                                             "\"shadow_map.resolution\" = [64, 128]\n"
                                             "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
    std::set<std::uint64_t> structures;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        structures.insert(space.structure(space.at(i)));
    }
    EXPECT_EQ(structures.size(), 8U);
    EXPECT_EQ(space.structure(space.at(0)), space.structure(space.at(2)));
    EXPECT_NE(space.structure(space.at(0)), space.structure(space.at(1)));
}

TEST(SweepSpace, SharesAStructureAmongZippedValuesThatComeAgain)
{
    const SweepSpace space = space_of(
        wall + "[sweep]\nmode = \"zip\"\n\"shadow_map.resolution\" = [64, 128, 64, 64]\n"
               "\"bias.slope\" = [1, 1, 1, 2]\n\"bias.constant\" = [0, 0.25, 0.5, 0.75]\n");
    EXPECT_EQ(space.structure(space.at(0)), space.structure(space.at(2)));
    EXPECT_NE(space.structure(space.at(0)), space.structure(space.at(1)));
    EXPECT_NE(space.structure(space.at(0)), space.structure(space.at(3)));
}

TEST(SweepSpace, TellsManyLongZippedAxesApart)
{
    // 256⁸ is 2⁶⁴: a product of the lengths would forget the first axis.
    std::string text = wall + "[sweep]\nmode = \"zip\"\n"
                              "\"bias.slope\" = {from = 1, to = 256, count = 256}\n";
    const std::string zeros = fmt::format("[{}]\n", fmt::join(std::vector<int>(256), ", "));
    for (const char* const key : {"bias.normal_texels", "shadow_map.roll_deg"}) {
        text += fmt::format("\"{}\" = {}", key, zeros);
    }
    const std::string ones = fmt::format("[{}]\n", fmt::join(std::vector<int>(256, 1), ", "));
    for (const char* const key :
         {"image.width", "image.height", "shadow_map.resolution", "shadow_map.far",
          "camera.vertical_fov_deg", "shadow_map.half_extent"}) {
        text += fmt::format("\"{}\" = {}", key, ones);
    }
    const SweepSpace space = space_of(text);
    ASSERT_EQ(space.axes().size(), 9U);
    std::set<std::uint64_t> structures;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        structures.insert(space.structure(space.at(i)));
    }
    EXPECT_EQ(structures.size(), 256U);
}

TEST(SweepSpace, KnowsTheBiasThatAJobHasWithoutItsAxes)
{
    const std::string cases = "[[case]]\nname = \"a\"\nbias.constant_m = 0.5\n"
                              "[[case]]\nname = \"b\"\n";
    const SweepSpace space =
        space_of(wall + "bias.constant = 0.125\n[sweep]\n\"bias.constant\" = [0, 0.25]\n"
                        "\"bias.slope\" = [3, 4]\n");
    EXPECT_EQ(space.job(space.at(3)).bias.constant, 0.25);
    EXPECT_EQ(space.own_constant_bias(space.at(3)).constant, 0.125);
    const SweepSpace metres =
        space_of(wall + "bias.constant = 0.125\n[sweep]\n\"bias.slope\" = [3, 4]\n" + cases);
    EXPECT_EQ(metres.own_constant_bias(metres.at(0)).constant_m, 0.5);
    EXPECT_EQ(metres.own_constant_bias(metres.at(2)).constant_m, std::nullopt);
    EXPECT_EQ(metres.own_constant_bias(metres.at(2)).constant, 0.125);
}

TEST(SweepSpace, HasNoOwnBiasWhereItDoesNotGoWithTheOtherKeys)
{
    // The spot refuses the file's metres; the axis replaces them.
    const SweepSpace space = space_of(
        wall + "bias.constant_m = 0.5\n[sweep]\n\"bias.constant\" = [0.25]\n"
               "[[case]]\nname = \"spot\"\nlight.type = \"spot\"\nlight.position = [0, 9, 0]\n"
               "light.target = [0, 0, 0]\n");
    EXPECT_EQ(space.job(space.at(0)).bias.constant, 0.25);
    const BiasSettings own = space.own_constant_bias(space.at(0));
    EXPECT_EQ(own.constant, 0);
    EXPECT_EQ(own.constant_m, std::nullopt);
}

TEST(SweepSpace, RefusesPointsWhoseKeysDoNotGoTogetherNamingTheAxis)
{
    const SweepSpace space =
        space_of(wall + "[sweep]\n\"shadow_map.near\" = [1, 5]\n\"shadow_map.far\" = [4, 9]\n");
    EXPECT_NO_THROW((void)space.job(space.at(0)));
    EXPECT_EQ(error_of([&] { return space.job(space.at(2)); }),
              "[sweep] shadow_map.near = 5: must be less than shadow_map.far ([sweep] "
              "shadow_map.far = 4)");
    const SweepSpace both =
        space_of(wall + "[sweep]\n\"bias.constant\" = [0, 1]\n\"bias.constant_m\" = [0, 1]\n");
    for (std::uint64_t i = 0; i < both.size(); ++i) {
        EXPECT_THAT(error_of([&] { return both.job(both.at(i)); }), HasSubstr("excludes it"));
    }
}

/// A random job with cases and axes, and the same once more as plain lists.
struct RandomSpace {
    std::string text = wall;
    std::vector<std::vector<std::string>> values;
    std::vector<bool> is_bias;
    std::size_t cases = 0;
    bool is_zipped = false;

    explicit RandomSpace(std::mt19937& random) : cases{random() % 4}, is_zipped{random() % 2 == 0}
    {
        const std::size_t length = 1 + random() % 4;
        const std::vector<std::pair<std::string, std::vector<std::string>>> pool{
            {"bias.slope", {"0", "1", "2", "3"}},
            {"bias.constant", {"0", "0.25", "0.5", "1"}},
            {"lookup.filter", {"\"nearest\"", "\"linear\"", "\"pcf3\"", "\"pcf5\""}},
            {"shadow_map.resolution", {"32", "64", "128", "256"}},
            {"shadow_map.cull", {"\"none\"", "\"front\"", "\"back\""}}};
        text += fmt::format("[sweep]\nmode = \"{}\"\n", is_zipped ? "zip" : "product");
        for (std::size_t i = 0; i < pool.size(); ++i) {
            // With zip the first axis never repeats a value, and so no tuple comes twice.
            std::vector<std::string> chosen = pool[i].second;
            std::shuffle(chosen.begin(), chosen.end(), random);
            if (is_zipped && i > 0) {
                chosen.clear();
                for (std::size_t k = 0; k < length; ++k) {
                    chosen.push_back(pool[i].second[random() % 3]);
                }
            }
            chosen.resize(is_zipped ? length : 1 + random() % chosen.size());
            if (random() % 3 != 0 || (is_zipped && i == 0)) {
                text += fmt::format("\"{}\" = [{}]\n", pool[i].first, fmt::join(chosen, ", "));
                values.push_back(chosen);
                is_bias.push_back(pool[i].first == "bias.constant");
            }
        }
        for (std::size_t i = 0; i < cases; ++i) {
            text += fmt::format("[[case]]\nname = \"{}\"\n", i);
        }
    }

    /// Every point by nested loops, as its case and the values.
    [[nodiscard]] std::vector<std::vector<std::string>> points() const
    {
        std::vector<std::vector<std::string>> all;
        for (std::size_t i = 0; i < std::max<std::size_t>(1, cases); ++i) {
            std::vector<std::vector<std::string>> rows{{cases == 0 ? "" : fmt::format("{}", i)}};
            if (is_zipped) {
                const auto first = rows[0];
                rows.clear();
                for (std::size_t k = 0; k < values[0].size(); ++k) {
                    rows.push_back(first);
                    for (const auto& axis : values) {
                        rows.back().push_back(axis[k]);
                    }
                }
            } else {
                for (const auto& axis : values) {
                    std::vector<std::vector<std::string>> longer;
                    for (const auto& row : rows) {
                        for (const std::string& value : axis) {
                            longer.push_back(row);
                            longer.back().push_back(value);
                        }
                    }
                    rows = longer;
                }
            }
            all.insert(all.end(), rows.begin(), rows.end());
        }
        return all;
    }
    /// The point without its constant bias.
    [[nodiscard]] std::vector<std::string> without_bias(std::vector<std::string> point) const
    {
        for (std::size_t i = 0; i < is_bias.size(); ++i) {
            if (is_bias[i]) {
                point[i + 1].clear();
            }
        }
        return point;
    }
};

TEST(SweepSpace, EnumeratesAsNestedLoopsDo)
{
    std::mt19937 random{11};
    for (int round = 0; round < 150; ++round) {
        const RandomSpace expected{random};
        SCOPED_TRACE(fmt::format("round {}: {}", round, expected.text));
        const SweepSpace space = space_of(expected.text);
        const auto points = expected.points();
        ASSERT_EQ(space.size(), points.size());
        std::map<std::vector<std::string>, std::uint64_t> structures;
        std::set<std::uint64_t> numbers;
        for (std::uint64_t i = 0; i < space.size(); ++i) {
            const SweepPoint point = space.at(i);
            std::vector<std::string> row{std::string{space.case_name(point)}};
            for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
                row.push_back(space.axes()[axis].values[point.values[axis]]);
            }
            ASSERT_EQ(row, points[i]) << "ordinal " << i;
            const auto entry =
                structures.emplace(expected.without_bias(row), space.structure(point)).first;
            EXPECT_EQ(entry->second, space.structure(point)) << "ordinal " << i;
            numbers.insert(space.structure(point));
        }
        EXPECT_EQ(numbers.size(), structures.size());
    }
}

TEST(SweepSpace, MakesTheJobOfAnotherBiasFromThatOfOne)
{
    std::mt19937 random{12};
    for (int round = 0; round < 40; ++round) {
        const RandomSpace drawn{random};
        SCOPED_TRACE(fmt::format("round {}: {}", round, drawn.text));
        const SweepSpace space = space_of(drawn.text);
        std::map<std::uint64_t, Job> jobs;
        for (std::uint64_t i = 0; i < space.size(); ++i) {
            const SweepPoint point = space.at(i);
            Job& job = jobs.try_emplace(space.structure(point), space.job(point)).first->second;
            space.set_constant_bias(job, point);
            EXPECT_EQ(resolved_keys(job), resolved_keys(space.job(point))) << "ordinal " << i;
        }
    }
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
                                   "to draw some of them; shorten the axes");
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

TEST(SweepSpace, RefusesAxisArgumentsThatAreNone)
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

TEST(SweepSpace, SurvivesAnyAxisArgument)
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
        // What does not throw an InputError was accepted; anything else ends the test.
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
