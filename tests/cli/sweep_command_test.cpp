// `gnomon sweep` as users run it.

#include "child_process.hpp"
#include "run_folder.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

constexpr int incomplete = 5;

TEST(Sweep, IsNotDoneAgain)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    const auto arguments = sweep(job, run, {"--axis", "bias.slope=0,0.01"});
    swept(arguments);
    const RunCsv first{run};
    const Ending again = swept(arguments);
    EXPECT_THAT(again.out, HasSubstr("nothing was left to do"));
    EXPECT_EQ(again.err, "");
    expect_same(RunCsv{run}, first);
    // More values compute what is new, and nothing else.
    const Ending more = swept(sweep(job, run, {"--axis", "bias.slope=0,0.005,0.01"}));
    EXPECT_THAT(more.out, HasSubstr("6 of 6 configurations done"));
    EXPECT_THAT(more.out, HasSubstr("2 bias curves"));
}

TEST(Sweep, MakesUpForTheErrorsAtAnotherJobsBias)
{
    const TemporaryFolder folder;
    const std::vector<std::string> axes{"--axis", "bias.constant=0,0.001,0.02", "--no-keep-pixels"};
    const path first = folder.write("first.toml", "bias.constant = 0.002" + two_lights);
    const path other = folder.write("other.toml", "bias.constant = 0.005" + two_lights);
    const path run = folder.path() / "run";
    const path fresh = folder.path() / "fresh";
    swept(sweep(first, run, axes));
    const RunCsv before{run};
    const Ending again = swept(sweep(other, run, axes));
    EXPECT_THAT(again.out, HasSubstr(" 2 bias curves\n")) << "one row of each curve is enough";
    swept(sweep(other, fresh, axes));
    expect_same(RunCsv{run}, RunCsv{fresh});
    EXPECT_NE(RunCsv{run}.error_vs_z, before.error_vs_z);
    // Back again everything is known.
    EXPECT_THAT(swept(sweep(first, run, axes)).out, HasSubstr("nothing was left to do"));
    expect_same(RunCsv{run}, before);
}

TEST(Sweep, MakesUpForPixelsThatWereNotKept)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--no-keep-pixels"}));
    EXPECT_FALSE(std::filesystem::exists(run / "pixels"));
    const RunCsv first{run};
    swept(sweep(job, run, {"--keep-pixels"}));
    EXPECT_EQ(entry_count(run / "pixels"), 2U);
    expect_same(RunCsv{run}, first);
    const Json status = Json::parse(gnomon({"status", run, "--json"}).out);
    EXPECT_THAT(status.at("resume").get<std::string>(), HasSubstr(" --keep-pixels"));
}

TEST(Sweep, IsNotReplacedByAComparison)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    swept(sweep(job, run));
    const Ending ending = gnomon({"compare", job, "--case", "sun", "--out", run});
    EXPECT_EQ(ending.exit_code, 2);
    EXPECT_THAT(ending.err, HasSubstr("holds a sweep, whose plan this would replace"));
    const path single = folder.path() / "single";
    swept({"compare", job, "--case", "sun", "--out", single});
    swept({"compare", job, "--case", "sun", "--out", single});
    EXPECT_EQ(csv_rows(single / "results.csv").size(), 1U);
    EXPECT_EQ(entry_count(single / "pixels"), 1U);
}

TEST(Sweep, RecordsWhatFails)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights + R"(
[[case]]
name = "lost"
scene.file = "lost.obj"
[sweep]
"shadow_map.near" = [0.5, 5]
"shadow_map.far" = [4, 9]
)");
    const path run = folder.path() / "run";
    const Ending ending = gnomon(sweep(job, run));
    EXPECT_EQ(ending.exit_code, incomplete) << ending.err;
    EXPECT_THAT(ending.out, StartsWith("6 of 12 configurations done, 6 failed: "));
    EXPECT_THAT(ending.err,
                HasSubstr(fmt::format("gnomon: 6 configurations failed; `gnomon status {}` says "
                                      "why, --retry failed tries again\n"
                                      "gnomon: 3 failed configurations cannot pass as they are "
                                      "given: change the keys that the message names",
                                      run.string())));
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 12U);
    for (const auto& row : rows) {
        const bool is_swapped = row.at("shadow_map.near") == "5" && row.at("shadow_map.far") == "4";
        const bool is_lost = row.at("case") == "lost";
        EXPECT_EQ(row.at("status"), is_swapped || is_lost ? "failed" : "done");
        EXPECT_THAT(row.at("message"), HasSubstr(is_swapped ? "must be less than shadow_map.far"
                                                 : is_lost  ? "lost.obj"
                                                            : ""));
        EXPECT_EQ(row.at("message").empty(), !is_swapped && !is_lost);
        EXPECT_EQ(row.at("pixels.total").empty(), is_swapped || is_lost);
    }
    const RunCsv first{run};

    // Again: what failed stays as it is.
    const Ending again = gnomon(sweep(job, run));
    EXPECT_EQ(again.exit_code, incomplete);
    EXPECT_THAT(again.out, HasSubstr("nothing was left to do"));
    expect_same(RunCsv{run}, first);

    // The scene was found: only what it needs is tried again, and what cannot be fails again.
    folder.write("lost.obj", "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n");
    const Ending retried = gnomon(sweep(job, run, {"--retry", "failed"}));
    EXPECT_EQ(retried.exit_code, incomplete) << retried.err;
    EXPECT_THAT(retried.out, StartsWith("9 of 12 configurations done, 3 failed: "));
    EXPECT_THAT(retried.out, HasSubstr("3 bias curves"));
}

TEST(Sweep, HasARowOfItsOwnForEachSceneThatCannotBeRead)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "image.width = 32\nimage.height = 18\n");
    const std::string ground = "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n";
    folder.write("there.obj", ground);
    const path run = folder.path() / "run";
    const auto arguments = sweep(job, run, {"--axis", "scene.file=there.obj,a.obj,b.obj"});
    EXPECT_EQ(gnomon(arguments).exit_code, incomplete);
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].at("status"), "done");
    for (const auto& [row, file] : {std::pair{1U, "a.obj"}, {2U, "b.obj"}}) {
        EXPECT_EQ(rows[row].at("status"), "failed");
        EXPECT_THAT(rows[row].at("scene.file"), HasSubstr(file));
        EXPECT_THAT(rows[row].at("message"), HasSubstr(file));
    }
    EXPECT_NE(rows[1].at("id"), rows[2].at("id"));
    // A file that was found is a configuration not computed yet: no --retry is needed.
    folder.write("a.obj", ground + "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 4 6 5\n");
    EXPECT_THAT(gnomon(arguments).out, StartsWith("2 of 3 configurations done, 1 failed: "));
}

TEST(Sweep, ComputesScenesOfEqualContentOnce)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "image.width = 32\nimage.height = 18\n");
    const std::string text = "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n"
                             "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 4 6 5\n";
    folder.write("a.obj", text);
    folder.write("b.obj", text);
    const std::vector<std::string> axes{"--axis", "scene.file=a.obj,b.obj", "--axis",
                                        "bias.constant=0,0.01"};
    for (const char* const pixels : {"--keep-pixels", "--no-keep-pixels"}) {
        const path run = folder.path() / pixels;
        const Ending ending = swept(sweep(job, run, with(axes, {pixels})));
        EXPECT_THAT(ending.out, HasSubstr("4 of 4 configurations done"));
        EXPECT_THAT(ending.out, HasSubstr("now: 1 scene, 1 truth, 1 receiver pass, 1 shadow map"));
        EXPECT_THAT(ending.out, HasSubstr("\n  2 configurations are the same as an earlier one"));
        const auto rows = csv_rows(run / "results.csv");
        ASSERT_EQ(rows.size(), 4U);
        for (const std::size_t i : {0U, 1U}) {
            EXPECT_EQ(rows[i].at("status"), "done");
            EXPECT_EQ(rows[i + 2].at("id"), rows[i].at("id"));
            EXPECT_EQ(rows[i + 2].at("false_shadow"), rows[i].at("false_shadow"));
        }
    }
    // Nor by two shards.
    std::size_t computed = 0;
    for (const char* const shard : {"1/2", "2/2"}) {
        const Ending ending = gnomon(sweep(job, folder.path() / ("part" + std::string{shard[0]}),
                                           with(axes, {"--no-keep-pixels", "--shard", shard})));
        EXPECT_EQ(ending.exit_code, 0) << ending.err;
        computed += ending.out.find("now: 1 scene") == std::string::npos ? 0U : 1U;
    }
    EXPECT_EQ(computed, 1U);
}

/// A quad with a camera `distance_m` before it, and a sun that looks along −z.
std::string quad_with_camera(int distance_m, bool is_lit)
{
    scene::testing::QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],)";
    if (is_lit) {
        gltf.more += R"("extensionsUsed":["KHR_lights_punctual"],)"
                     R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}},)";
    }
    gltf.nodes = fmt::format(
        R"([{{"name":"quad","mesh":0}},{{"camera":0,"translation":[0.5,0.5,{}]}},)"
        R"({{"name":"lamp"{}}}])",
        distance_m, is_lit ? R"(,"extensions":{"KHR_lights_punctual":{"light":0}})" : "");
    gltf.roots = "[0,1,2]";
    return gltf.text();
}

/// A row but for its place in the sweep.
std::map<std::string, std::string> without_ordinal(std::map<std::string, std::string> row)
{
    row.erase("ordinal");
    return row;
}

TEST(Sweep, TellsFilesOfEqualTrianglesApartByTheirCamerasAndLights)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "image.width = 32\nimage.height = 18\n"
                                              "scene.ground = true\n");
    folder.write("near.gltf", quad_with_camera(4, false));
    folder.write("far.gltf", quad_with_camera(8, false));
    folder.write("lit.gltf", quad_with_camera(4, true));
    folder.write("twin.gltf", quad_with_camera(4, false));
    const std::vector<std::string> files{"near.gltf", "far.gltf", "lit.gltf", "twin.gltf"};
    const std::vector<std::string> axes{"--axis",
                                        "scene.file=near.gltf,far.gltf,lit.gltf,twin.gltf",
                                        "--axis", "bias.constant=0,0.01"};
    const path run = folder.path() / "run";
    for (const char* const pixels : {"--keep-pixels", "--no-keep-pixels"}) {
        SCOPED_TRACE(pixels);
        std::filesystem::remove_all(run);
        const Ending ending = swept(sweep(job, run, with(axes, {pixels})));
        EXPECT_THAT(ending.out, HasSubstr("now: 3 scenes, 3 truths, "));
        EXPECT_THAT(ending.out, HasSubstr("\n  2 configurations are the same as an earlier one"));
        const auto rows = csv_rows(run / "results.csv");
        ASSERT_EQ(rows.size(), 8U);
        for (std::size_t i = 0; i < 6; ++i) {
            const path alone = folder.path() / fmt::format("{}{}", files[i / 2], pixels);
            swept(sweep(job, alone,
                        {"--axis", fmt::format("scene.file={}", files[i / 2]), "--axis",
                         "bias.constant=0,0.01", pixels}));
            EXPECT_EQ(without_ordinal(rows[i]),
                      without_ordinal(csv_rows(alone / "results.csv").at(i % 2)));
            EXPECT_EQ(rows[i].at("scene_hash"), rows[0].at("scene_hash"));
        }
        EXPECT_NE(rows[0].at("pixels.background"), rows[2].at("pixels.background"));
        EXPECT_NE(rows[0].at("pixels.lit"), rows[4].at("pixels.lit"));
        EXPECT_EQ(rows[0].at("id"), rows[6].at("id"));
    }
    // By shards too.
    std::vector<std::string> merge{"merge", folder.path() / "all"};
    for (const char* const shard : {"1/3", "2/3", "3/3"}) {
        merge.push_back(folder.path() / fmt::format("part{}", shard[0]));
        swept(sweep(job, merge.back(), with(axes, {"--no-keep-pixels", "--shard", shard})));
    }
    swept(merge);
    expect_same(RunCsv{folder.path() / "all"}, RunCsv{run});
    // `compare` names it alike.
    const path single = folder.path() / "single";
    swept({"compare", job, "--set", fmt::format("scene.file={}/lit.gltf", folder.path().string()),
           "--set", "bias.constant=0", "--out", single});
    EXPECT_EQ(csv_rows(single / "results.csv").at(0).at("id"),
              csv_rows(run / "results.csv").at(4).at("id"));
    // Where the job has both, the files are the same.
    const Ending same = swept(sweep(job, folder.path() / "same",
                                    with(axes, {"--set", "camera.eye=[0.5, 0.5, 5]", "--set",
                                                "light.direction=[-1, -1, -1]"})));
    EXPECT_THAT(same.out, HasSubstr("now: 1 scene, 1 truth, "));
    EXPECT_THAT(same.out, HasSubstr("\n  6 configurations are the same as an earlier one"));
}

TEST(Sweep, OfNothingThatCanBeComputedIsRefused)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    expect_refused(
        gnomon(sweep(job, run, {"--axis", "shadow_map.near=5,6", "--set", "shadow_map.far=4"})), 2,
        "must be less than shadow_map.far");
    expect_refused(gnomon(sweep(job, run, {"--axis", "scene.file=a.obj,b.obj"})), 2, "a.obj");
}

TEST(Sweep, RefusesAFolderThatMayNotBeWritten)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.write("file", "text");
    for (const path& run : {file, file / "run", path{"/proc/self/run"}}) {
        expect_refused(gnomon(sweep(job, run)), 4, "cannot lock " + run.string());
    }
}

TEST(SweepDryRun, CountsTheWorkAndWritesNothing)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const std::vector<std::string> arguments{
        "sweep",
        job,
        "--dry-run",
        "--axis",
        "shadow_map.near=0.5,1",
        "--axis",
        "shadow_map.resolution=16,32,64",
        "--axis",
        "bias.constant={from = 1e-6, to = 0.1, count = 500, scale = \"log\"}"};
    const Ending text = gnomon(arguments);
    expect_done(text);
    EXPECT_THAT(text.out,
                StartsWith("6,000 configurations: 2 shadow_map.near × 3 shadow_map.resolution × "
                           "500 bias.constant × 2 cases\n"
                           "  1 scene, 2 truths, 4 receiver passes, 12 shadow maps, 12 lookup "
                           "passes, 12 bias curves\n"
                           "  roughly "));
    EXPECT_THAT(text.out, AllOf(HasSubstr(" s on two cores"), HasSubstr(" MiB of memory")));
    const Ending json = gnomon(with(arguments, {"--json"}));
    expect_done(json);
    const Json plan = Json::parse(json.out);
    EXPECT_EQ(plan.at("schema"), 1);
    EXPECT_EQ(plan.at("configurations"), 6000);
    EXPECT_EQ(plan.at("refused"), 0);
    EXPECT_EQ(plan.at("plan"), (Json{{"configurations", 6000},
                                     {"scenes", 1},
                                     {"truths", 2},
                                     {"receiver_passes", 4},
                                     {"shadow_maps", 12},
                                     {"lookup_passes", 12},
                                     {"bias_curves", 12}}));
    EXPECT_GT(plan.at("estimated_seconds"), 0);
    EXPECT_GT(plan.at("estimated_bytes"), 0);
    EXPECT_EQ(entry_count(folder.path()), 1U);
}

TEST(SweepDryRun, CountsWhatIsRefused)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const Ending ending = gnomon({"sweep", job, "--dry-run", "--axis", "shadow_map.near=0.5,5",
                                  "--axis", "shadow_map.far=4,9"});
    expect_done(ending);
    EXPECT_THAT(ending.out, StartsWith("8 configurations: "));
    EXPECT_THAT(ending.out,
                HasSubstr("  2 of them will fail, the first as [sweep] shadow_map.near = 5: "
                          "must be less than shadow_map.far ([sweep] shadow_map.far = 4)\n"));
}

TEST(SweepDryRun, NeedsNeitherGlNorTheScene)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "scene.file = \"lost.obj\"\n");
    Start start;
    start.environment = {"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"};
    expect_done(gnomon({"sweep", job, "--dry-run", "--axis", "bias.slope=0,1"}, start));
}

TEST(SweepProgress, IsPlainLinesWhenPiped)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const Ending ending = swept(sweep(job, folder.path() / "run", {"--axis", "bias.slope=0,0.01"}));
    EXPECT_THAT(ending.err, StartsWith("gnomon sweep: 0/4 done: spot, bias.slope 0\n"));
    EXPECT_THAT(ending.err, HasSubstr("gnomon sweep: 4/4 done"));
    EXPECT_THAT(ending.err, Not(HasSubstr("\x1b")));
    EXPECT_THAT(ending.err, Not(HasSubstr("\r")));
    EXPECT_EQ(ending.err.back(), '\n');
}

TEST(SweepProgress, IsSilentWhenQuiet)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    expect_done(gnomon(sweep(job, folder.path() / "run", {"--axis", "bias.slope=0", "--quiet"})));
}

TEST(SweepProgress, IsALiveLineOnATerminal)
{
    if (!is_installed("script")) {
        GTEST_SKIP() << "no `script`, which has a terminal to give";
    }
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    // `script` takes one command line, and the program's path is not known here but to `gnomon`.
    const std::string program = gnomon({"--version"}).command;
    const std::string command = fmt::format("{} sweep {} --out {} --axis bias.slope=0,0.01",
                                            program.substr(0, program.find(' ')), job.string(),
                                            (folder.path() / "run").string());
    const Ending ending = run({"script", "-qec", command, "/dev/null"});
    EXPECT_EQ(ending.exit_code, 0) << ending.out;
    EXPECT_THAT(ending.out, HasSubstr("\r\x1b[K4/4 done"));
    EXPECT_THAT(ending.out, Not(HasSubstr("\x1b[3"))) << "no colours";
}

TEST(SweepCommandLine, RefusesInOneLine)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"sweep", job}, "no --out RUN"},
        {{"sweep", "--out", run}, "no job"},
        {sweep(job, run, {"--builtin", "wall"}), "--builtin"},
        {sweep(job, run, {"--axis", "bias.slpe=1"}), "the nearest is bias.slope"},
        {sweep(job, run, {"--axis", "bias.slope"}), "write KEY=VALUES"},
        {sweep(job, run, {"--axis", "bias.slope=1,1.0"}), "1 comes twice"},
        {sweep(job, run, {"--axis", "bias.slope=1", "--set", "bias.slope=2"}),
         "is an axis of the sweep"},
        {sweep(job, run, {"--axis", "light.direction=[0,-1,0],[1,-1,0]"}),
         "[[case]] \"sun\": light.direction is an axis of the sweep too"},
        {sweep(job, run, {"--case", "snu"}), "the nearest is \"sun\""},
        {sweep(job, run, {"--shard", "0/2"}), "--shard 0/2: must be k/n"},
        {sweep(job, run, {"--shard", "3/2"}), "must be k/n"},
        {sweep(job, run, {"--shard", "1"}), "must be k/n"},
        {sweep(job, run, {"--shard", "1/2x"}), "must be k/n"},
        {sweep(job, run, {"--shard", "-1/2"}), "must be k/n"},
        {sweep(job, run, {"--shard", "1/99999999999999999999"}), "must be k/n"},
        {sweep(job, run, {"--keep-pixels", "--no-keep-pixels"}), "exclude each other"},
        {sweep(job, run, {"--retry", "all"}), "--retry"},
        {sweep(job, run, {"--threads", "-1"}), "--threads"},
        {sweep(job, run, {"--axes", "bias.slope=1"}), "--axes"},
        {sweep(folder.path() / "none.toml", run), "none.toml"}};
    for (const auto& [arguments, expected] : cases) {
        expect_refused(gnomon(arguments), 2, expected);
    }
    EXPECT_FALSE(std::filesystem::exists(run)) << "nothing was begun";
}

TEST(SweepCommandLine, RefusesJsonOfAResult)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    expect_refused(gnomon(sweep(job, folder.path() / "run", {"--json"})), 2, "--dry-run");
}

} // namespace
} // namespace gnomon::testing
