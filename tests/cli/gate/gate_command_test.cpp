#include "gate_folder.hpp"
#include "lane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using store::ExampleRun;
using store::RunStore;
using ::testing::HasSubstr;
using GateJson = nlohmann::json;

/// The number of pixels in the finding `new_pixels`, which must name some of them and a picture.
int new_pixel_count(const GateJson& found)
{
    for (const GateJson& finding : found.at("findings")) {
        if (finding.at("metric") == "new_pixels") {
            EXPECT_EQ(finding.at("pixels").at("first").size(), 10U);
            EXPECT_EQ(finding.at("pixels").at("box").size(), 4U);
            return finding.at("now").get<int>();
        }
    }
    return 0;
}

/// Changes a job, and expects the gate to find it with this cause and this suspect.
void expect_regression(const std::vector<std::string>& before, const std::string& change,
                       const std::string& cause, const std::string& suspect,
                       const std::string& builtin = "sphere-plane")
{
    GateFolder folder;
    folder.builtin = builtin;
    // In the usual lane changes of few pixels are tried at the full image size only.
    const std::vector<std::string> half{"--set", "image.width=160", "--set", "image.height=90"};
    const bool is_whole = tests::runs_full_tests() || before.empty();
    const auto settings = is_whole ? before : with(half, before);
    folder.compare("before", settings);
    folder.compare("after", with(settings, {"--set", change}));
    expect_done(folder.save("before"));
    if (is_whole) {
        const Ending own = folder.gate("before", {"--json"});
        EXPECT_EQ(own.exit_code, 0) << own.err;
        EXPECT_TRUE(GateJson::parse(own.out).at("findings").empty()) << own.out;
    }

    const Ending ending = folder.gate("after");
    EXPECT_EQ(ending.exit_code, 1) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("REGRESSION"));
    EXPECT_THAT(ending.out, HasSubstr("dominant cause: " + cause + ","));
    EXPECT_THAT(ending.out, HasSubstr("first suspects: " + suspect + "\n"));
    EXPECT_THAT(ending.out, HasSubstr("see it: gnomon compare --builtin " + builtin + " "));

    const Ending json = folder.gate("after", {"--json"});
    EXPECT_EQ(json.exit_code, 1);
    const GateJson found = GateJson::parse(json.out);
    EXPECT_EQ(found.at("result"), "regression");
    EXPECT_GE(new_pixel_count(found), 100) << json.out;
    const GateJson& worst = found.at("findings").at(0);
    EXPECT_EQ(worst.at("reason"), "worse_than_baseline");
    EXPECT_EQ(worst.at("dominant_cause"), cause);
    EXPECT_GE(worst.at("now").get<int>() - worst.at("baseline").get<int>(), 100);
    EXPECT_EQ(worst.at("changed_parameters").size(), 1U);
}

TEST(GateCommand, FindsFourTimesTheBias)
{
    expect_regression({"--set", "bias.constant=0.24"}, "bias.constant=0.96", "bias",
                      "bias.constant: 0.24 -> 0.96");
}

TEST(GateCommand, FindsHalfTheResolution)
{
    expect_regression({}, "shadow_map.resolution=256", "resolution",
                      "shadow_map.resolution: 512 -> 256");
}

TEST(GateCommand, FindsAHundredthOfTheNearPlane)
{
    // A constant bias in depth units is 100 times as long then.
    expect_regression({"--set", "shadow_map.depth_format=d16"}, "shadow_map.near=0.005", "bias",
                      "shadow_map.near: 0.5 -> 0.005");
}

TEST(GateCommand, FindsPrecisionLostToTheNearPlane)
{
    // Only the near plane's precision changes: an offset along the normal has no depth units.
    expect_regression({"--set", "light.type=spot", "--set", "shadow_map.depth_format=d16", "--set",
                       "bias.constant=0", "--set", "bias.normal_texels=3", "--set",
                       "shadow_map.resolution=2048", "--set", "shadow_map.near=1"},
                      "shadow_map.near=0.01", "precision", "shadow_map.near: 1 -> 0.01", "yard");
}

TEST(GateCommand, FindsACoarserDepthFormat)
{
    expect_regression({"--set", "bias.constant=1e-6", "--set", "shadow_map.near=0.01", "--set",
                       "shadow_map.resolution=2048"},
                      "shadow_map.depth_format=d16", "precision",
                      "shadow_map.depth_format: d24 -> d16");
}

TEST(GateCommand, PassesImprovementsAndReportsThem)
{
    const GateFolder folder;
    folder.compare("before", {});
    folder.compare("after", {"--set", "bias.constant=0.024"});
    expect_done(folder.save("before"));
    const Ending ending = folder.gate("after");
    EXPECT_EQ(ending.exit_code, 0) << ending.out;
    EXPECT_THAT(ending.out, HasSubstr("better than in the baseline\n"));
}

/// Expects that the gate passes a change and calls it better.
void expect_improvement(const std::string& builtin, const std::vector<std::string>& before,
                        const std::string& change)
{
    GateFolder folder;
    folder.builtin = builtin;
    folder.compare("before", before);
    folder.compare("after", with(before, {"--set", change}));
    expect_done(folder.save("before"));
    const Ending ending = folder.gate("after");
    EXPECT_EQ(ending.exit_code, 0) << builtin << change << ending.out;
    EXPECT_THAT(ending.out, HasSubstr("better than in the baseline\n"));
}

TEST(GateCommand, PassesAnImprovementThatMovesCausesAndBorders)
{
    expect_improvement("yard", {}, "shadow_map.resolution=4096");
    if (tests::runs_full_tests()) {
        expect_improvement("terrain", {}, "shadow_map.resolution=4096");
        expect_improvement("yard",
                           {"--set", "light.type=spot", "--set", "bias.constant=2e-5", "--set",
                            "shadow_map.depth_format=d16"},
                           "shadow_map.depth_format=d24");
    }
    expect_improvement("yard",
                       {"--set", "light.type=spot", "--set", "bias.constant=1e-4", "--set",
                        "shadow_map.near=0.01"},
                       "shadow_map.near=1");
}

TEST(GateCommand, PassesASweepAgainstItsOwnBaseline)
{
    const GateFolder folder;
    ExampleRun{2, 3}.compute(folder.at("run"));
    const Ending saved = folder.save("run");
    expect_done(saved);
    EXPECT_THAT(saved.out,
                HasSubstr("baseline.json: 6 configurations, without masks of wrong pixels\n"));
    const Ending ending = folder.gate("run");
    expect_done(ending);
    EXPECT_THAT(ending.out, HasSubstr("pass: 6 configurations compared with "));
    const Ending list = gnomon({"baseline", "list", folder.at("baseline.json")});
    expect_done(list);
    EXPECT_THAT(
        list.out,
        HasSubstr("noon, bias.constant = 9.999999974752427e-07, shadow_map.resolution = 256\n"));
    const Ending diff = gnomon({"baseline", "diff", folder.at("baseline.json"), folder.at("run")});
    expect_done(diff);
    EXPECT_EQ(diff.out, "0 of 6 configurations differ, 0 missing, 0 new\n");
}

TEST(GateCommand, AllowsNoPixelWhileTheJobIsUnchanged)
{
    const GateFolder folder;
    const ExampleRun run{2, 3};
    run.compute(folder.at("run"));
    record_example(folder.at("worse"), run,
                   [](auto&, auto& curves) { ++curves[1].rows[2].result.metrics.false_lit; });
    expect_done(folder.save("run"));
    const Ending ending = folder.gate("worse", {"--json"});
    EXPECT_EQ(ending.exit_code, 1);
    const GateJson found = GateJson::parse(ending.out);
    ASSERT_EQ(found.at("findings").size(), 1U);
    const GateJson& finding = found.at("findings").at(0);
    EXPECT_EQ(finding.at("metric"), "false_lit");
    EXPECT_EQ(finding.at("configuration").at("axes").at("shadow_map.resolution"), "257");
    EXPECT_TRUE(finding.at("changed_parameters").empty());
}

TEST(GateCommand, EndsWithThreeInAnotherEnvironmentUnlessAllowed)
{
    const GateFolder folder;
    const ExampleRun run{2, 3};
    run.compute(folder.at("run"));
    record_example(folder.at("other"), run, [](auto& description, auto&) {
        description.environment.gl_renderer = "radeonsi";
    });
    expect_done(folder.save("run"));
    expect_refused(folder.gate("other"), 3, "--allow-environment");
    const Ending allowed = folder.gate("other", {"--allow-environment"});
    expect_done(allowed);
    EXPECT_THAT(allowed.out, HasSubstr("compared all the same (--allow-environment)"));
    EXPECT_THAT(allowed.out, HasSubstr("radeonsi"));
    EXPECT_EQ(GateJson::parse(folder.gate("other", {"--allow-environment", "--json"}).out)
                  .at("same_environment"),
              false);
}

TEST(GateCommand, EndsWithThreeWithoutABaseline)
{
    const GateFolder folder;
    ExampleRun{1, 1}.compute(folder.at("run"));
    expect_refused(folder.gate("run"), 3, "there is no baseline");
    expect_refused(gnomon({"baseline", "list", folder.at("none.json")}), 3, "there is no baseline");
}

TEST(GateCommand, EndsWithFiveIfResultsAreMissing)
{
    const GateFolder folder;
    const ExampleRun run{2, 3};
    run.compute(folder.at("run"));
    expect_done(folder.save("run"));
    std::filesystem::create_directories(folder.at("part"));
    {
        RunStore store{folder.at("part"), RunStore::Access::write};
        store.plan(run.description(), run.configurations());
        run.record(store, 1, {1});
        store.record_failure(std::vector<std::uint64_t>{3}, "no memory");
    }
    const Ending part = folder.gate("part");
    EXPECT_EQ(part.exit_code, 5);
    EXPECT_THAT(part.out, HasSubstr("the run is not complete: 1 failed, 2 missing"));
    EXPECT_THAT(part.out, HasSubstr("3 configurations of the baseline that the run lacks"));
    const Ending saved = folder.save("part");
    expect_refused(saved, 5, "1 configurations failed and 2 are missing");
    ExampleRun{1, 3}.compute(folder.at("fewer"));
    const Ending fewer = folder.gate("fewer", {"--json"});
    EXPECT_EQ(fewer.exit_code, 5);
    EXPECT_EQ(GateJson::parse(fewer.out).at("missing").size(), 3U);
    ExampleRun{3, 3}.compute(folder.at("more"));
    const Ending more = folder.gate("more");
    expect_done(more);
    EXPECT_THAT(more.out, HasSubstr("3 configurations of the run that the baseline lacks"));
}

TEST(GateCommand, TakesRulesFromAFile)
{
    const GateFolder folder;
    ExampleRun{2, 3}.compute(folder.at("run"));
    expect_done(folder.save("run"));
    const auto judged_by = [&](const std::string& text) {
        folder.write("gate.toml", text);
        return folder.gate("run", {"--rules", folder.at("gate.toml")});
    };
    const std::string rule = "[[rule]]\nid = \"few\"\nmetric = \"false_shadow\"\n";
    const Ending broken = judged_by(rule + "max = 1000");
    EXPECT_EQ(broken.exit_code, 1);
    EXPECT_THAT(broken.out, HasSubstr("max 1,000: few\n"));
    const Ending warned = judged_by(rule + "max = 1000\nseverity = \"warn\"");
    expect_done(warned);
    EXPECT_THAT(warned.out, HasSubstr("warning, max 1,000: few\n"));
    expect_done(judged_by(rule + "max = 2000\n[[rule]]\nid = \"none\"\nmetric = \"false_lit\"\n"
                                 "max = 0\nwhere = {case = \"dusk\"}\noptional = true"));
    expect_refused(judged_by(rule + "max = 1\nwhere = {case = \"dusk\"}"), 2,
                   "gate.toml:2: rule \"few\" matches nothing");
    expect_refused(judged_by(rule + "maxx = 1"), 2, "gate.toml:4: maxx: is not a key of a rule");
}

TEST(GateCommand, RefusesWhatIsNoRunOrBaseline)
{
    const GateFolder folder;
    ExampleRun{1, 1}.compute(folder.at("run"));
    folder.write("baseline.json", "{\"schema\": 1");
    expect_refused(folder.gate("run"), 2, "baseline.json: not JSON, or cut short");
    expect_refused(folder.gate("none"), 2, "there is no results.sqlite");
    expect_refused(gnomon({"gate", folder.at("run")}), 2, "--baseline is required");
    expect_refused(gnomon({"baseline"}), 2, "A subcommand is required");
    expect_refused(gnomon({"baseline", "save", folder.at("run"), "--baseline", "/nowhere/b.json"}),
                   4, "/nowhere/b.json");
}

} // namespace
} // namespace gnomon::testing
