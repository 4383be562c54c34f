#include "child_process.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;

Ending tune(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "tune");
    return gnomon(small(std::move(arguments)));
}

TEST(TuneCommand, PrintsAFragmentWithWhichCompareMeasuresWhatWasPromised)
{
    const Ending ending = tune({"--builtin", "sphere-plane", "--max-false-shadow", "5%",
                                "--max-false-lit", "0.05", "--max-resolution", "512", "--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const Json result = Json::parse(ending.out);
    EXPECT_TRUE(result.at("meets_limits").get<bool>());
    for (const char* const name : {"shadow_amount", "light_amount"}) { // nearest: counts
        const char* const count = name[0] == 's' ? "false_shadow" : "false_lit";
        EXPECT_EQ(result.at("recommended").at(name), result.at("recommended").at(count));
    }
    EXPECT_LE(result.at("measured").at("false_shadow_rate").get<double>(), 0.05);
    EXPECT_LE(result.at("measured").at("false_lit_rate").get<double>(), 0.05);
    EXPECT_NE(ending.err.find("gnomon tune: searching for up to 30 s"), std::string::npos)
        << ending.err;
    EXPECT_EQ(result.at("views").size(), 1U);
    EXPECT_EQ(result.at("views")[0].at("measured").at("false_lit"),
              result.at("measured").at("false_lit"));
    EXPECT_EQ(result.at("states").at("Vulkan").size(), 6U);
    EXPECT_NE(result.at("states").at("GL").dump().find("float bias = "), std::string::npos)
        << result.at("states");

    const TemporaryFolder folder;
    const auto job = folder.path() / "tuned.toml";
    std::ofstream{job} << "[scene]\nbuiltin = \"sphere-plane\"\n"
                       << result.at("toml").get<std::string>();
    const Ending compared = gnomon(small({"compare", job.string(), "--json"}));
    expect_done(compared);
    const Json measured = Json::parse(compared.out);
    for (const char* const name : {"false_shadow", "false_lit"}) {
        EXPECT_EQ(measured.at(name), result.at("measured").at(name)) << name;
        EXPECT_EQ(measured.at(name), result.at("recommended").at(name)) << name;
    }
}

TEST(TuneCommand, PrintsAFragmentThatAJobOfItsMethodTakes)
{
    const Ending ending = tune({"--builtin", "sphere-plane", "--set", "method.name=vsm", "--set",
                                "method.kernel_width=3", "--max-false-shadow", "10%",
                                "--max-false-lit", "10%", "--max-resolution", "256", "--json"});
    const Json result = Json::parse(ending.out);
    const TemporaryFolder folder;
    const auto job = folder.path() / "tuned.toml";
    std::ofstream{job} << "[scene]\nbuiltin = \"sphere-plane\"\n[method]\nname = \"vsm\"\n"
                          "kernel_width = 3\n"
                       << result.at("toml").get<std::string>();
    const Ending compared = gnomon(small({"compare", job.string(), "--json"}));
    expect_done(compared);
    EXPECT_EQ(Json::parse(compared.out).at("false_lit"), result.at("measured").at("false_lit"));
}

TEST(TuneCommand, RecommendsNoFilterThatShadowsItselfByLessThanHalf)
{
    // By count, any bias is right that leaves less than half of the taps shadowed.
    const Ending ending =
        tune({"--builtin", "tilted-plane", "--set", "scene.tilted-plane.angle_deg=60", "--set",
              "lookup.filter=pcf5", "--max-resolution", "256", "--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const Json result = Json::parse(ending.out);
    EXPECT_EQ(result.at("recommended").at("shadow_amount"), 0);
    EXPECT_EQ(result.at("measured").at("shadow_amount"), 0);
    EXPECT_GT(result.at("recommended").at("bias.constant").get<double>(), 0);
}

TEST(TuneCommand, LimitsCountsBesideAmounts)
{
    const std::vector<std::string> amounts_alone{
        "--builtin", "sphere-plane",       "--set", "lookup.filter=pcf3", "--max-resolution",
        "256",       "--max-false-shadow", "50%",   "--max-false-lit",    "50%"};
    EXPECT_EQ(tune(amounts_alone).exit_code, 0);
    auto counts_too = amounts_alone;
    counts_too.insert(counts_too.end(),
                      {"--max-false-shadow-count", "0", "--max-false-lit-count", "0"});
    const Ending ending = tune(counts_too);
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_NE(ending.out.find("; by count false shadow at most 0 %, false lit at most 0 %"),
              std::string::npos)
        << ending.out;
}

TEST(TuneCommand, EndsWithOneWhereNoSettingMeetsTheLimits)
{
    const Ending ending = tune({"--builtin", "columns", "--max-false-shadow", "0",
                                "--max-false-lit", "0", "--max-resolution", "256"});
    EXPECT_EQ(ending.exit_code, 1);
    EXPECT_NE(ending.out.find("No setting up to 256x256 meets the limits"), std::string::npos)
        << ending.out;
    EXPECT_NE(ending.out.find("shadow_map = { "), std::string::npos) << ending.out;
}

TEST(TuneCommand, AnswersInTenLinesWithinLimitsThatTheSceneAllows)
{
    const std::vector<std::string> job{
        "--builtin",
        "columns",
        "--max-resolution",
        "512",
        "--set",
        tests::in_lane("scene.columns.slices=16", "scene.columns.slices=64")};
    const Ending ending = tune(job);
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_LE(std::ranges::count(ending.out, '\n'), 10) << ending.out;
    EXPECT_NE(ending.out.find("--verbose lists"), std::string::npos) << ending.out;
    auto as_json = job;
    as_json.emplace_back("--json");
    const Json result = Json::parse(tune(as_json).out);
    const Json& limits = result.at("limits");
    EXPECT_TRUE(limits.at("relative").get<bool>());
    EXPECT_GE(limits.at("max_shadow_amount_rate").get<double>(), 0.0002);
    EXPECT_LE(result.at("recommended").at("map_bytes"), result.at("least_wrong").at("map_bytes"));
    auto verbose = job;
    verbose.emplace_back("--verbose");
    const std::string all = tune(verbose).out;
    EXPECT_NE(all.find("Vulkan:"), std::string::npos) << all;
    EXPECT_GT(std::ranges::count(all, '\n'), 40);
}

TEST(TuneCommand, SaysHowToGoOnWhenTheTimeIsUp)
{
    // Only the first setting is tried: evaluating the view takes longer than the time for it.
    const Ending ending = tune({"--builtin", "columns", "--set", "image.width=1280", "--set",
                                "image.height=720", "--time", "1", "--json"});
    const Json result = Json::parse(ending.out);
    EXPECT_EQ(result.at("time_s"), 1);
    EXPECT_EQ(ending.exit_code, result.at("meets_limits").get<bool>() ? 0 : 1);
    expect_refused(tune({"--builtin", "wall", "--time", "0"}), 2, "--time");
    expect_refused(tune({"--builtin", "wall", "--time", "9", "--methods", "all"}), 2, "--time");
}

TEST(TuneCommand, RendersTheBiasesOfHardwareFilters)
{
    const Ending ending =
        tune({"--builtin", "wall", "--set", "lookup.filter=hardware", "--max-false-shadow", "50%",
              "--max-false-lit", "50%", "--max-resolution", "256", "--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_TRUE(Json::parse(ending.out).at("meets_limits").get<bool>());
}

TEST(TuneCommand, RecommendsNothingWhereNoPixelIsLit)
{
    // The room's light comes through a window, and its own view shows none of it.
    const std::vector<std::string> job{"--builtin", "room", "--max-resolution", "256"};
    const Ending ending = tune(job);
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_EQ(ending.out.find("Nothing is recommended: no scored pixel of this view is lit"), 0U)
        << ending.out;
    EXPECT_EQ(ending.out.find(" = { "), std::string::npos) << ending.out;
    auto as_json = job;
    as_json.emplace_back("--json");
    const Json result = Json::parse(tune(as_json).out);
    EXPECT_FALSE(result.at("meets_limits").get<bool>());
    EXPECT_TRUE(result.at("recommended").is_null());
    EXPECT_EQ(result.at("why").size(), 1U);
}

TEST(TuneCommand, RefusesACameraThatSeesNothingToScore)
{
    expect_refused(tune({"--builtin", "wall", "--set", "camera.target=[0,99,0]", "--set",
                         "camera.eye=[0,50,0.1]", "--max-resolution", "256"}),
                   2, "no pixel is scored; aim it");
}

TEST(TuneCommand, RefusesSharesAndSizesThatAreNone)
{
    expect_refused(tune({"--builtin", "wall", "--max-false-shadow", "much"}), 2,
                   "--max-false-shadow much: must be a share");
    expect_refused(tune({"--builtin", "wall", "--max-false-lit", "101%"}), 2, "--max-false-lit");
    expect_refused(tune({"--builtin", "wall", "--max-resolution", "0"}), 2, "--max-resolution");
    expect_refused(tune({"--builtin", "wall", "--max-resolution", "100"}), 2, "allow at least 256");
}

TEST(Advise, MeasuresChangesAndPromisesNothing)
{
    const std::string builtin = tests::in_lane("fence", "yard");
    const std::vector<std::string> job{
        "compare", "--builtin", builtin, "--set", "shadow_map.resolution=256", "--json"};
    const Json plain = Json::parse(gnomon(small(job)).out);
    EXPECT_TRUE(plain.at("advice").is_null());
    std::vector<std::string> advising = job;
    advising.emplace_back("--advise");
    const Ending ending = gnomon(small(advising));
    expect_done(ending);
    const Json result = Json::parse(ending.out);
    EXPECT_EQ(result.at("causes"), plain.at("causes"));
    ASSERT_FALSE(result.at("advice").empty());
    // A comparison with these keys gives the same.
    for (const Json& advice : result.at("advice")) {
        std::vector<std::string> changed{
            "compare", "--builtin", builtin, "--set", "shadow_map.resolution=256", "--json"};
        for (const std::string& key : advice.at("keys").get<std::vector<std::string>>()) {
            const std::size_t equals = key.find(" = ");
            changed.emplace_back("--set");
            changed.push_back(fmt::format("{}={}", key.substr(0, equals), key.substr(equals + 3)));
        }
        const Json measured = Json::parse(gnomon(small(changed)).out);
        EXPECT_EQ(measured.at("false_shadow"), advice.at("false_shadow")) << advice;
        EXPECT_EQ(measured.at("false_lit"), advice.at("false_lit")) << advice;
    }
}

TEST(Advise, NeedsTheExactTruth)
{
    expect_refused(gnomon(small({"compare", "--builtin", "wall", "--advise", "--truth", "float"})),
                   2, "--advise needs --truth exact");
}

} // namespace
} // namespace gnomon::testing
