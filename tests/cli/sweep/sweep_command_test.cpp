// `gnomon sweep` as users run it.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
    EXPECT_EQ(again.err, fmt::format("gnomon sweep: wrote {}\n", run.string()));
    expect_same(RunCsv{run}, first);
    // With more values only the new configurations are computed.
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
    // With the first values again, everything is known.
    EXPECT_THAT(swept(sweep(first, run, axes)).out, HasSubstr("nothing was left to do"));
    expect_same(RunCsv{run}, before);
}

constexpr const char* small_job = R"(
[scene]
builtin = "sphere-plane"
[image]
width = 48
height = 27
[shadow_map]
resolution = 128
[bias]
constant = 0.002
)";

/// 22 configurations, with the job's own among them or not.
std::vector<std::string> many_biases(const std::string& further)
{
    return {"--axis", "shadow_map.resolution=64,128", "--axis",
            "bias.constant=0,0.0001,0.0002,0.0003,0.0004,0.0005,0.0006,0.0007,0.0008,0.01," +
                further};
}

TEST(Sweep, KeepsThePixelsOfItsExtremesWhateverItsSize)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", small_job);
    const auto swept_into = [&](const char* name, const std::string& further,
                                const std::vector<std::string>& more) {
        const path run = folder.path() / name;
        return std::pair{run, swept(sweep(job, run, with(many_biases(further), more)))};
    };
    const auto [run, ending] = swept_into("own", "0.002", {});
    EXPECT_THAT(ending.out, HasSubstr("pixels kept: of the best, the worst, the job's own"));
    EXPECT_EQ(kept_images(run), 3U);
    EXPECT_THAT(swept({"report", run}).out, HasSubstr("pixels of 3 configurations"));
    const auto [others, without_own] = swept_into("others", "0.1", {});
    EXPECT_THAT(without_own.out, HasSubstr("pixels kept: of the best, the worst;"));
    EXPECT_EQ(kept_images(others), 2U);
    const auto [none, silent] = swept_into("none", "0.1", {"--no-keep-pixels"});
    EXPECT_THAT(silent.out, Not(HasSubstr("pixels kept")));
    EXPECT_FALSE(std::filesystem::exists(none / "pixels"));
    // A baseline keeps no masks of the best and the worst configuration of a single run.
    const path baseline = folder.path() / "baseline.json";
    EXPECT_THAT(swept({"baseline", "save", run, "--baseline", baseline}).out,
                HasSubstr("without masks of wrong pixels"));
}

TEST(Sweep, KeepsThePixelsOfItsExtremesWhereTheJobsOwnSceneIsNotThere)
{
    const TemporaryFolder folder;
    folder.write("there.obj", "v 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n");
    const path job = folder.write("job.toml", R"(
scene.file = "gone.obj"
image.width = 48
image.height = 27
)");
    const path run = folder.path() / "run";
    swept(sweep(job, run, with(many_biases("0.1"), {"--axis", "scene.file=there.obj"})));
    EXPECT_EQ(kept_images(run), 2U);
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
    EXPECT_EQ(kept_images(run), 2U);
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
    EXPECT_THAT(ending.err, HasSubstr("holds a sweep, which this would replace"));
    const path single = folder.path() / "single";
    swept({"compare", job, "--case", "sun", "--out", single});
    swept({"compare", job, "--case", "sun", "--out", single});
    EXPECT_EQ(csv_rows(single / "results.csv").size(), 1U);
    EXPECT_EQ(kept_images(single), 1U);
}

/// If a method's prefilter fails, other methods still use the same map.
TEST(Sweep, LosesNoOtherConfigurationWhereAMethodsPassesFail)
{
    const TemporaryFolder folder;
    const std::vector<std::string> small{
        "--builtin", "wall",
        "--set",     "image.width=64",
        "--set",     "image.height=36",
        "--set",     "method.name=vsm",
        "--set",     tests::in_lane("shadow_map.resolution=256", "shadow_map.resolution=4096")};
    if (gnomon(with(with({"compare"}, small), {"--set", "method.samples=8"})).exit_code == 0) {
        GTEST_SKIP() << "this driver has 8 samples of a texel";
    }
    const path run = folder.path() / "run";
    const Ending ending =
        gnomon(with(with({"sweep", "--out", run.string()}, small),
                    {"--axis", "method.kernel_width=1,3", "--axis", "method.samples=1,8"}));
    EXPECT_EQ(ending.exit_code, incomplete) << ending.err;
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 4U);
    for (const auto& row : rows) {
        const bool fails = row.at("method.samples") == "8";
        EXPECT_EQ(row.at("status"), fails ? "failed" : "done") << row.at("message");
        EXPECT_THAT(row.at("message"),
                    HasSubstr(fails ? "method.samples = 8: this driver supports" : ""));
    }
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

    // Failures stay without --retry.
    const Ending again = gnomon(sweep(job, run));
    EXPECT_EQ(again.exit_code, incomplete);
    EXPECT_THAT(again.out, HasSubstr("nothing was left to do"));
    expect_same(RunCsv{run}, first);

    // The scene now exists: only failures that it may fix are retried.
    folder.write("lost.obj", "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n");
    const Ending retried = gnomon(sweep(job, run, {"--retry", "failed"}));
    EXPECT_EQ(retried.exit_code, incomplete) << retried.err;
    EXPECT_THAT(retried.out, StartsWith("9 of 12 configurations done, 3 failed: "));
    EXPECT_THAT(retried.out, HasSubstr("3 bias curves"));
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
        expect_refused(gnomon(sweep(job, run)), 4,
                       run.string() + ": the folder cannot be created: ");
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
                                     {"prefilters", 0},
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
    if (run({"script", "-qec", "true", "/dev/null"}).exit_code != 0) {
        GTEST_SKIP() << "no `script`, or no terminal that it could give";
    }
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    // `script` takes one command line, and only `gnomon()` knows the program's path.
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
        {sweep(job, run, {"--keep-pixels", "--no-keep-pixels"}), "mutually exclusive"},
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
