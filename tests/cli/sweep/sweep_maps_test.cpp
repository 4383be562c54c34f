// Sweeps of lights with several maps give the results of comparisons.

#include "child_process.hpp"
#include "lane.hpp"
#include "row_compared.hpp"
#include "run_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;
using Row = std::map<std::string, std::string>;
using Words = std::vector<std::string>;

const Words cascades{
    "--builtin", "columns",
    "--set",     "shadow_map.layout=cascades",
    "--set",     "shadow_map.resolution=64",
    "--set",     "bias.slope=0.5",
    "--set",     tests::in_lane("scene.columns.slices=16", "scene.columns.slices=64")};
const Words cube{"--builtin", "lamp-room", "--set", "shadow_map.resolution=32"};

/// Runs a sweep into a folder.
void sweep_into(const path& run, const Words& job, const Words& more)
{
    swept(small(with(with({"sweep", "--out", run, "--quiet"}, job), more)));
}

/// The result of `gnomon compare` for a row's configuration.
Json compared(const Words& job, const Row& row, const Words& keys)
{
    Words words{"compare", "--json"};
    words.insert(words.end(), job.begin(), job.end());
    for (const std::string& key : keys) {
        words.insert(words.end(), {"--set", key + "=" + row.at(key)});
    }
    const Ending ending = gnomon(small(words));
    expect_done(ending);
    return Json::parse(ending.out);
}

void expect_number(const Row& row, const std::string& column, const Json& value)
{
    ASSERT_FALSE(row.at(column).empty()) << column;
    EXPECT_EQ(std::strtod(row.at(column).c_str(), nullptr), value.get<double>()) << column;
}

/// Expects that a map's row equals its entry in the JSON.
void expect_map_compares(const Row& row, const Json& map)
{
    const std::string name = map.at("map");
    EXPECT_EQ(row.at("map"), (name.find_first_of("+-") == 0 ? "'" : "") + name);
    for (const char* const column : {"near_m", "far_m", "texel_m", "lit", "blocked", "false_shadow",
                                     "false_lit", "shadow_amount", "light_amount"}) {
        expect_number(row, column, map.at(column));
    }
    for (const auto& [cause, pixels] : map.at("causes").items()) {
        expect_number(row, "causes." + cause, pixels);
    }
    if (map.contains("begin_m")) {
        expect_number(row, "begin_m", map.at("begin_m"));
        expect_number(row, "end_m", map.at("end_m"));
        expect_number(row, "bias_m", map.at("bias").at("constant_m"));
    } else {
        EXPECT_EQ(row.at("begin_m") + row.at("end_m") + row.at("bias_m"), "");
    }
}

/// Expects that each configuration's rows equal a comparison of it alone.
void expect_maps_compare(const path& run, const Words& job, const Words& keys, std::size_t maps)
{
    const auto rows = csv_rows(run / "by_map.csv");
    const auto results = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), maps * results.size());
    // The usual lane compares every third.
    for (std::size_t i = 0; i < results.size(); i += tests::in_lane(3U, 1U)) {
        const Json alone = compared(job, results[i], keys);
        ASSERT_EQ(alone.at("by_map").size(), maps);
        std::size_t wrong = 0;
        for (std::size_t map = 0; map < maps; ++map) {
            const Row& row = rows[maps * i + map];
            SCOPED_TRACE("row " + std::to_string(maps * i + map));
            EXPECT_EQ(row.at("id"), results[i].at("id"));
            EXPECT_EQ(row.at("curve"), results[i].at("curve"));
            EXPECT_EQ(row.at("map_index"), std::to_string(map));
            expect_map_compares(row, alone.at("by_map").at(map));
            wrong += std::stoul(row.at("false_shadow")) + std::stoul(row.at("false_lit"));
        }
        EXPECT_EQ(wrong, std::stoul(results[i].at("false_shadow")) +
                             std::stoul(results[i].at("false_lit")));
    }
}

const Words filters_and_biases{"--axis", "lookup.filter=nearest,pcf3", "--axis",
                               "bias.constant=-0.001,0,0.003,0.05"};
const Words swept_keys{"lookup.filter", "bias.constant"};

TEST(ErrorsByMap, OfCascadesAreThoseOfAComparison)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    sweep_into(run, cascades, with(filters_and_biases, {"--no-keep-pixels"}));
    expect_maps_compare(run, cascades, swept_keys, 4);
}

TEST(ErrorsByMap, OfACubeAreThoseOfAComparison)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    sweep_into(run, cube, with(filters_and_biases, {"--no-keep-pixels"}));
    expect_maps_compare(run, cube, swept_keys, 6);
}

TEST(ErrorsByMap, OfMixedCascadesAreThoseOfAComparison)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    const Words mixed = with(cascades, {"--set", "shadow_map.blend=0.3"});
    sweep_into(run, mixed, {"--axis", "bias.constant=0,0.003", "--no-keep-pixels"});
    expect_maps_compare(run, mixed, {"bias.constant"}, 4);
}

TEST(ErrorsByMap, AreTheSameWhetherPixelsAreKeptOrNot)
{
    const TemporaryFolder folder;
    for (const Words& job : {cascades, cube}) {
        std::string first;
        for (const char* const pixels : {"--keep-pixels", "--no-keep-pixels"}) {
            const path run = folder.path() / "run";
            sweep_into(run, job, with(filters_and_biases, {pixels}));
            const std::string text = text_of(run / "by_map.csv");
            EXPECT_TRUE(first.empty() || text == first);
            first = text;
            std::filesystem::remove_all(run);
        }
    }
}

TEST(ErrorsByMap, AreOfTheConfigurationsAloneThatHaveSeveralMaps)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    sweep_into(run, cascades, {"--axis", "shadow_map.cascades=2,3"});
    EXPECT_EQ(csv_rows(run / "by_map.csv").size(), 5U);
    const path other = folder.path() / "other";
    sweep_into(other, {"--builtin", "wall"}, {"--axis", "bias.constant=0,0.01"});
    EXPECT_FALSE(exists(other / "by_map.csv"));
}

/// A bias in metres is a different number of depth units in each cascade, so it has its own curve.
TEST(SweepOfMetres, IsOfCascadesWhatComparisonsAre)
{
    const TemporaryFolder folder;
    const path run = folder.path() / "run";
    sweep_into(run, cascades, {"--axis", "bias.constant_m=0.01,0.05,0.3", "--no-keep-pixels"});
    for (const Row& row : csv_rows(run / "results.csv")) {
        expect_row_compares(row, compared(cascades, row, {"bias.constant_m"}));
    }
    expect_maps_compare(run, cascades, {"bias.constant_m"}, 4);
}

TEST(SweepOfMetres, HasACurveBesideThatOfDepthUnits)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", R"(
scene.builtin = "columns"
shadow_map.layout = "cascades"
shadow_map.resolution = 64
[[case]]
name = "metres"
bias.constant_m = 0.05
[[case]]
name = "depth units"
bias.constant = 0.003
)");
    const path run = folder.path() / "run";
    swept(small(sweep(job, run, {"--no-keep-pixels", "--quiet"})));
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_NE(rows[0].at("curve"), rows[1].at("curve"));
}

} // namespace
} // namespace gnomon::testing
