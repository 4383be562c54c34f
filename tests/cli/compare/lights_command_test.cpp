// Jobs with several lights: results, files, sweeps, gates.

#include "child_process.hpp"
#include "exr_layers.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using Row = std::map<std::string, std::string>;
using std::filesystem::path;

/// In the usual lane the columns have few faces.
const std::string three_lights = std::string{"[scene]\nbuiltin = \"columns\"\n"} +
                                 tests::in_lane("columns.slices = 16\n", "") + R"([image]
width = 96
height = 64
[lookup]
position = "pixel"
[shadow_map]
resolution = 128
[[lights]]
name = "sun"
type = "directional"
direction = [-0.4, -1, -0.3]
[[lights]]
name = "torch"
type = "spot"
position = [3, 5, 4]
target = [0, 0, 0]
cone_deg = 70
shadow_map.depth_format = "d16"
bias.constant = 0.001
[[lights]]
name = "lamp"
type = "point"
position = [0.5, 3, 0.7]
lookup.filter = "pcf3"
)";
const std::vector<std::string> light_names{"sun", "torch", "lamp"};

const std::string two_axes = "[sweep]\n\"lights.sun.shadow_map.resolution\" = [64, 128, 256]\n"
                             "\"bias.slope\" = [0, 0.001]\n";

std::string out_of(const std::vector<std::string>& arguments)
{
    const Ending ending = gnomon(arguments);
    EXPECT_EQ(ending.exit_code, 0) << ending.command << "\n" << ending.err;
    return ending.out;
}

Json json_of(std::vector<std::string> arguments)
{
    arguments.emplace_back("--json");
    return Json::parse(out_of(arguments));
}

using Channels = std::map<std::string, std::vector<std::uint32_t>>;

class Lights : public ::testing::Test {
protected:
    [[nodiscard]] path at(const std::string& name) const { return folder_.path() / name; }
    [[nodiscard]] path written(const std::string& name, const std::string& text) const
    {
        return folder_.write(name, text);
    }
    [[nodiscard]] path job(const std::string& more = {}) const
    {
        return written("job.toml", three_lights + more);
    }

private:
    TemporaryFolder folder_;
};

TEST_F(Lights, EachResultIsThatOfAJobWithThatLightAlone)
{
    const Json all = json_of({"compare", job(), "--aov", at("all.exr")});
    const Channels layers = store::read_exr(at("all.exr")).channels;
    ASSERT_EQ(all.at("lights").size(), light_names.size());
    std::size_t channel_count = 0;
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < light_names.size(); ++i) {
        const path aov = at(light_names[i] + ".exr");
        Json alone = json_of({"compare", job(), "--light", light_names[i], "--aov", aov});
        Json light = all.at("lights")[i];
        EXPECT_EQ(light.at("name"), light_names[i]);
        light.erase("name");
        alone.erase("schema");
        // Times, and which of several occluders a ray hit first, vary between runs.
        for (const char* const of_a_run : {"seconds", "truth_signs"}) {
            light.erase(of_a_run);
            alone.erase(of_a_run);
        }
        EXPECT_EQ(light.dump(), alone.dump());
        wrong += alone.at("false_shadow").get<std::uint64_t>();
        for (const auto& [channel, values] : store::read_exr(aov).channels) {
            const auto found = layers.find(fmt::format("{}.{}", light_names[i], channel));
            ASSERT_NE(found, layers.end()) << light_names[i] << "." << channel;
            EXPECT_TRUE(channel == "witness" || found->second == values) << found->first;
            ++channel_count;
        }
    }
    EXPECT_EQ(layers.size(), channel_count);
    EXPECT_EQ(all.at("false_shadow"), wrong);
    EXPECT_EQ(all.at("pixels").at("total"), 3 * 96 * 64);
}

TEST_F(Lights, TheTableEndsWithAllOfThem)
{
    const std::string table = out_of({"compare", job(), "--verbose"});
    std::vector<std::string> lines;
    std::istringstream in{table};
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    for (const std::string& name : light_names) {
        EXPECT_NE(table.find("-- light " + name + " ---"), std::string::npos);
    }
    const Json all = json_of({"compare", job()});
    const auto together = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
        return line.starts_with("all lights ");
    });
    ASSERT_NE(together, lines.end());
    EXPECT_NE(together->find(fmt::format("{}", all.at("false_lit").get<int>())), std::string::npos);
}

TEST_F(Lights, EachHasFilesOfItsOwn)
{
    out_of({"compare", job(), "--picture", at("p.png"), "--depth-map", at("d.exr"), "--heat-map",
            fmt::format("cause={}", at("c.png").string()), "--view-depths", at("v.csv"),
            "--export-case", at("case")});
    for (const std::string& name : light_names) {
        for (const std::string& file :
             {"p." + name + ".png", "d." + name + ".exr", "c." + name + ".png",
              "v." + name + ".csv", "case/" + name + "/case.toml"}) {
            EXPECT_TRUE(std::filesystem::exists(at(file))) << file;
        }
        const Json case_result = json_of({"evaluate", at("case/" + name)});
        const Json own = json_of({"compare", job(), "--light", name});
        EXPECT_EQ(case_result.at("false_shadow"), own.at("false_shadow"));
        EXPECT_EQ(case_result.at("causes"), own.at("causes"));
    }
    EXPECT_FALSE(std::filesystem::exists(at("p.png")));
    expect_refused(gnomon({"compare", job(), "--export-case", at("case")}), 2, "case/sun/");
}

/// "Three light sources: four renderings and three texture maps".
TEST_F(Lights, ThreeTakeFourRenderingsAndThreeMaps)
{
    const Json plan = json_of({"sweep", job(), "--dry-run"}).at("plan");
    EXPECT_EQ(plan.at("receiver_passes"), 1);
    EXPECT_EQ(plan.at("shadow_maps"), 3);
    EXPECT_EQ(plan.at("truths"), 3);
}

TEST_F(Lights, ASweepOverOneLightsKeysRedoesNothingOfTheOthers)
{
    const std::string out =
        out_of({"sweep", job(two_axes), "--out", at("run"), "--no-keep-pixels"});
    EXPECT_NE(out.find("18 of 18 configurations done"), std::string::npos) << out;
    EXPECT_NE(out.find("1 scene, 3 truths, 1 receiver pass, 5 shadow maps"), std::string::npos)
        << out;
    EXPECT_NE(out.find("8 configurations are the same as an earlier one"), std::string::npos)
        << out;
    const auto rows = csv_rows(at("run") / "results.csv");
    ASSERT_EQ(rows.size(), 6 * 4U);
    for (std::size_t i = 0; i < rows.size(); i += 4) {
        const Row& total = rows[i];
        EXPECT_EQ(total.at("light"), "");
        EXPECT_EQ(total.at("id"), "");
        EXPECT_EQ(total.at("status"), "done");
        for (const char* const column : {"pixels.total", "pixels.lit", "false_shadow", "false_lit",
                                         "labels.acne", "causes.bias", "map_bytes"}) {
            std::uint64_t sum = 0;
            for (std::size_t light = 1; light <= 3; ++light) {
                sum += std::stoull(rows[i + light].at(column));
            }
            EXPECT_EQ(total.at(column), fmt::format("{}", sum)) << column;
        }
        for (std::size_t light = 1; light <= 3; ++light) {
            const Row& row = rows[i + light];
            EXPECT_EQ(row.at("light"), light_names[light - 1]);
            EXPECT_EQ(row.at("ordinal"), total.at("ordinal"));
            EXPECT_EQ(row.at("lights.sun.shadow_map.resolution"),
                      total.at("lights.sun.shadow_map.resolution"));
            EXPECT_EQ(row.at("shadow_map.resolution"),
                      light == 1 ? row.at("lights.sun.shadow_map.resolution") : "128");
        }
        EXPECT_EQ(total.at("bias.slope"), rows[i + 1].at("bias.slope")); // shared by all lights
        EXPECT_EQ(total.at("light.type"), "");
    }
    // Each light's rows equal those of a sweep with that light alone.
    for (const std::string& name : light_names) {
        const path run = at("only-" + name);
        // An axis may have the name that it has among all lights.
        out_of({"sweep", job(two_axes), "--light", name, "--out", run, "--no-keep-pixels", "--axis",
                fmt::format("lights.{}.lookup.outside=[\"lit\"]", name)});
        std::map<std::string, Row> alone;
        for (const Row& row : csv_rows(run / "results.csv")) {
            EXPECT_FALSE(row.contains("light"));
            alone[row.at("id")] = row;
        }
        for (const Row& row : rows) {
            if (row.at("light") == name) {
                ASSERT_TRUE(alone.contains(row.at("id"))) << name;
                for (const auto& [column, cell] : alone[row.at("id")]) {
                    EXPECT_TRUE(column == "ordinal" || row.at(column) == cell) << column;
                }
            }
        }
    }
}

TEST_F(Lights, PartsOfASweepMakeTheWhole)
{
    const path file = job(two_axes);
    out_of({"sweep", file, "--out", at("whole")});
    for (const char* const part : {"1/2", "2/2"}) {
        out_of({"sweep", file, "--out", at(fmt::format("part{}", part[0])), "--shard", part});
    }
    out_of({"merge", at("merged"), at("part1"), at("part2")});
    EXPECT_EQ(text_of(at("merged") / "results.csv"), text_of(at("whole") / "results.csv"));
    const std::string again = out_of({"sweep", file, "--out", at("whole")});
    EXPECT_NE(again.find("nothing was left to do"), std::string::npos) << again;
    // Parts of a sweep with one light belong to another sweep.
    out_of({"sweep", file, "--out", at("sun"), "--light", "sun", "--shard", "1/2"});
    expect_refused(gnomon({"merge", at("mixed"), at("part1"), at("sun")}), 2,
                   "belongs to another sweep than");
}

TEST_F(Lights, AFailedLightFailsItsTotal)
{
    const path file = job("[sweep]\n\"lights.torch.shadow_map.near\" = [0.5, 30]\n");
    const Ending ending =
        gnomon({"sweep", file, "--out", at("run"), "--set", "lights.torch.shadow_map.far=20"});
    EXPECT_EQ(ending.exit_code, 5) << ending.out << ending.err;
    const auto rows = csv_rows(at("run") / "results.csv");
    ASSERT_EQ(rows.size(), 8U);
    EXPECT_EQ(rows[0].at("status"), "done");
    EXPECT_EQ(rows[4].at("status"), "failed");
    EXPECT_EQ(rows[4].at("false_shadow"), "");
    EXPECT_EQ(rows[5].at("status"), "done");
    EXPECT_EQ(rows[6].at("status"), "failed");
    EXPECT_EQ(rows[7].at("status"), "done");
}

TEST_F(Lights, TheGateNamesTheLightThatIsWorse)
{
    out_of({"sweep", job(), "--out", at("run"), "--keep-pixels"});
    out_of({"baseline", "save", at("run"), "--baseline", at("baseline.json")});
    const Json baseline = Json::parse(text_of(at("baseline.json")));
    EXPECT_EQ(baseline.at("axes"), Json::array({"light"}));
    EXPECT_EQ(baseline.at("configurations").size(), 3U);
    out_of({"gate", at("run"), "--baseline", at("baseline.json")});
    out_of({"sweep", job(), "--out", at("worse"), "--keep-pixels", "--set",
            "lights.torch.bias.constant=0"});
    const Ending gate = gnomon({"gate", at("worse"), "--baseline", at("baseline.json")});
    EXPECT_EQ(gate.exit_code, 1) << gate.out;
    EXPECT_NE(gate.out.find("light = torch"), std::string::npos) << gate.out;
    EXPECT_EQ(gate.out.find("light = sun"), std::string::npos) << gate.out;
    EXPECT_NE(gate.out.find("--light=torch"), std::string::npos) << gate.out; // shows it
}

TEST_F(Lights, ACompareRunKeepsThePixelsOfEach)
{
    out_of({"compare", job(), "--out", at("run")});
    const auto rows = csv_rows(at("run") / "results.csv");
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        EXPECT_TRUE(std::filesystem::exists(at("run/pixels/" + rows[i].at("id") + ".exr")));
    }
    out_of({"report", at("run"), "--out", at("page")});
    // It may be repeated and replaced, as a comparison with one light may.
    out_of({"compare", job(), "--out", at("run")});
    out_of({"compare", job(), "--light", "sun", "--out", at("run")});
    EXPECT_EQ(csv_rows(at("run") / "results.csv").size(), 1U);
    out_of({"compare", job(), "--out", at("run")});
    EXPECT_EQ(csv_rows(at("run") / "results.csv").size(), 4U);
}

TEST_F(Lights, TotalsAreTheSameInJsonAndCsv)
{
    const Json all = json_of({"compare", job(), "--out", at("run")}).flatten();
    const Row total = csv_rows(at("run") / "results.csv").front();
    int compared = 0;
    for (const auto& [pointer, value] : all.items()) {
        std::string column = pointer.substr(1);
        std::ranges::replace(column, '/', '.');
        const auto cell = total.find(column);
        if (cell != total.end() && (value.is_number() || value.is_null()) && column != "schema") {
            EXPECT_EQ(cell->second.empty(), value.is_null()) << column;
            EXPECT_TRUE(value.is_null() || std::stod(cell->second) == value.get<double>())
                << column;
            ++compared;
        }
    }
    EXPECT_GT(compared, 50);
}

TEST_F(Lights, TuneAndAdviceAnswerForEach)
{
    const Json tuned =
        Json::parse(gnomon({"tune", job(), "--max-resolution", "256", "--quiet", "--json"}).out);
    ASSERT_EQ(tuned.at("lights").size(), 3U);
    EXPECT_EQ(tuned.at("lights")[1].at("name"), "torch");
    EXPECT_TRUE(tuned.at("lights")[1].at("toml").get<std::string>().starts_with(
        "# [[lights]] torch\n[lights.shadow_map]\n"));
    const Json alone = Json::parse(
        gnomon({"tune", job(), "--light", "lamp", "--max-resolution", "256", "--quiet", "--json"})
            .out);
    EXPECT_EQ(alone.at("recommended"), tuned.at("lights")[2].at("recommended"));
    const Json advised = json_of({"compare", job(), "--advise"});
    for (const Json& light : advised.at("lights")) {
        EXPECT_FALSE(light.at("remedies").empty()) << light.at("name");
    }
}

TEST_F(Lights, OfTheExampleAreThree)
{
    const path example = path{GNOMON_ROOT} / "examples" / "lights.toml";
    const Json result = json_of(small({"compare", example}));
    ASSERT_EQ(result.at("lights").size(), 3U);
    for (const Json& light : result.at("lights")) {
        EXPECT_GT(light.at("pixels").at("lit"), 0) << light.at("name");
    }
}

/// A glTF quad under a point light, a sun and a spot whose cone no shadow map can cover.
std::string quad_with_lights()
{
    scene::test::QuadGltf gltf;
    gltf.more = R"("extensionsUsed":["KHR_lights_punctual"],)"
                R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"},)"
                R"({"type":"directional"},{"type":"spot","spot":{"outerConeAngle":1.6}}]}},)";
    gltf.nodes = R"([{"mesh":0},{"name":"Lamp A","translation":[0.2,0.4,1],)"
                 R"("extensions":{"KHR_lights_punctual":{"light":0}}},)"
                 R"({"name":"Sun","extensions":{"KHR_lights_punctual":{"light":1}}},)"
                 R"({"name":"Wide","extensions":{"KHR_lights_punctual":{"light":2}}}])";
    gltf.roots = "[0,1,2,3]";
    return gltf.text();
}

TEST_F(Lights, OfASceneFileMayAllBeUsed)
{
    const path model = written("quad.gltf", quad_with_lights());
    const std::vector<std::string> all{"compare", model, "--set", "scene.lights=all"};
    const Json result = json_of(all);
    ASSERT_EQ(result.at("lights").size(), 2U);
    EXPECT_EQ(result.at("lights")[0].at("name"), "lamp-a");
    EXPECT_EQ(result.at("lights")[1].at("name"), "sun");
    // The first equals the file's own light.
    const Json own = json_of({"compare", model});
    EXPECT_EQ(result.at("lights")[0].at("pixels"), own.at("pixels"));
    EXPECT_EQ(result.at("lights")[0].at("false_shadow"), own.at("false_shadow"));
    // A light's keys override the file's light; other lights are added.
    const path file = written("job.toml", "[scene]\nfile = \"quad.gltf\"\nlights = \"all\"\n"
                                          "[[lights]]\nname = \"sun\"\n"
                                          "shadow_map.resolution = 64\n"
                                          "[[lights]]\nname = \"mine\"\n"
                                          "direction = [0, 0, -1]\n");
    const Json more = json_of({"compare", file});
    ASSERT_EQ(more.at("lights").size(), 3U);
    EXPECT_EQ(more.at("lights")[1].at("job").at("shadow_map.resolution"), 64);
    EXPECT_EQ(more.at("lights")[1].at("pixels"), result.at("lights")[1].at("pixels"));
    EXPECT_EQ(more.at("lights")[2].at("name"), "mine");
}

TEST_F(Lights, CommandsOfOneLightAskWhichOne)
{
    const path aov = at("all.exr");
    out_of({"compare", job(), "--aov", aov});
    expect_refused(gnomon({"certify", aov, job()}), 2,
                   "the job has several lights: choose one with --light, sun or torch or lamp");
    const path lamp = at("lamp.exr");
    out_of({"compare", job(), "--light", "lamp", "--aov", lamp});
    out_of({"certify", lamp, job(), "--light", "lamp"});
    for (const std::string& name : light_names) {
        out_of({"certify", aov, job(), "--light", name});
    }
    expect_refused(gnomon({"certify", lamp, job(), "--light", "sun"}), 2,
                   "give the job that the AOV was made from");
    expect_refused(gnomon({"compare", job(), "--light", ""}), 2, "no light \"\"; there are sun");
    expect_refused(gnomon({"compare", job(), "--light", "moon"}), 2,
                   "no light \"moon\"; there are sun, torch, lamp");
    expect_refused(gnomon({"compare", "--builtin", "wall", "--light", "sun"}), 2,
                   "no light \"sun\": the job has only one light, without a name");
}

} // namespace
} // namespace gnomon::testing
