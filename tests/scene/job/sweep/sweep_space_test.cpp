// The configurations that a job's cases and axes span.

#include "job_fixture.hpp"

#include "scene/job/keys/key_table.hpp"

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

/// A point's case and values, as the axes write them.
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
    // The expected numbers come from Floyd's algorithm over MT19937-64, implemented in another
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
    EXPECT_THAT(space_refusal(wall, {}, "dusk"), HasSubstr("the job defines no [[case]]"));
}

TEST(SweepSpace, LaysFileCaseOverridesAndAxesOverEachOther)
{
    const SweepSpace space =
        space_of(wall + "shadow_map.resolution = 64\nlookup.filter = \"linear\"\nbias.slope = 1\n"
                        "bias.constant = 0.125\n"
                        "[sweep]\n\"bias.slope\" = [4]\n"
                        "[[case]]\nname = \"a\"\nlookup.filter = \"pcf3\"\nbias.constant = 0.25\n",
                 {}, {}, {{"bias.constant", "0.5"}});
    const auto keys = texts_by_key(space.job(space.at(0)));
    EXPECT_EQ(keys.at("shadow_map.resolution"), "64");
    EXPECT_EQ(keys.at("lookup.filter"), "\"pcf3\"");
    EXPECT_EQ(keys.at("bias.constant"), "0.5");
    EXPECT_EQ(keys.at("bias.slope"), "4");
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

TEST(SweepSpace, SharesACurveGroupIffOnlyConstantBiasesDiffer)
{
    const SweepSpace space = space_of(wall + "[sweep]\n\"bias.slope\" = [0, 1]\n"
                                             "\"bias.constant\" = [0, 0.5]\n"
                                             "\"shadow_map.resolution\" = [64, 128]\n"
                                             "[[case]]\nname = \"a\"\n[[case]]\nname = \"b\"\n");
    std::set<std::uint64_t> groups;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        groups.insert(space.curve_group(space.at(i)));
    }
    EXPECT_EQ(groups.size(), 8U);
    EXPECT_EQ(space.curve_group(space.at(0)), space.curve_group(space.at(2)));
    EXPECT_NE(space.curve_group(space.at(0)), space.curve_group(space.at(1)));
}

TEST(SweepSpace, SharesACurveGroupAmongZippedValuesThatComeAgain)
{
    const SweepSpace space = space_of(
        wall + "[sweep]\nmode = \"zip\"\n\"shadow_map.resolution\" = [64, 128, 64, 64]\n"
               "\"bias.slope\" = [1, 1, 1, 2]\n\"bias.constant\" = [0, 0.25, 0.5, 0.75]\n");
    EXPECT_EQ(space.curve_group(space.at(0)), space.curve_group(space.at(2)));
    EXPECT_NE(space.curve_group(space.at(0)), space.curve_group(space.at(1)));
    EXPECT_NE(space.curve_group(space.at(0)), space.curve_group(space.at(3)));
}

TEST(SweepSpace, TellsManyLongZippedAxesApart)
{
    // 256⁸ is 2⁶⁴: a product of the lengths would overflow and lose the first axis.
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
    std::set<std::uint64_t> groups;
    for (std::uint64_t i = 0; i < space.size(); ++i) {
        groups.insert(space.curve_group(space.at(i)));
    }
    EXPECT_EQ(groups.size(), 256U);
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
        EXPECT_THAT(error_of([&] { return both.job(both.at(i)); }),
                    HasSubstr("mutually exclusive"));
    }
}

/// A random job with cases and axes, and its points as plain lists.
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
        std::map<std::vector<std::string>, std::uint64_t> groups;
        std::set<std::uint64_t> numbers;
        for (std::uint64_t i = 0; i < space.size(); ++i) {
            const SweepPoint point = space.at(i);
            std::vector<std::string> row{std::string{space.case_name(point)}};
            for (std::size_t axis = 0; axis < space.axes().size(); ++axis) {
                row.push_back(space.axes()[axis].values[point.values[axis]]);
            }
            ASSERT_EQ(row, points[i]) << "ordinal " << i;
            const auto entry =
                groups.emplace(expected.without_bias(row), space.curve_group(point)).first;
            EXPECT_EQ(entry->second, space.curve_group(point)) << "ordinal " << i;
            numbers.insert(space.curve_group(point));
        }
        EXPECT_EQ(numbers.size(), groups.size());
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
            Job& job = jobs.try_emplace(space.curve_group(point), space.job(point)).first->second;
            space.set_constant_bias(job, point);
            EXPECT_EQ(resolved_keys(job), resolved_keys(space.job(point))) << "ordinal " << i;
        }
    }
}

} // namespace
} // namespace gnomon::scene::test
