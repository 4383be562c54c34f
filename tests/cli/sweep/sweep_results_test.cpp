// Results of `gnomon sweep` are reproducible and equal those of `gnomon compare`.

#include "child_process.hpp"
#include "lane.hpp"
#include "row_compared.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// Compares each row of the run with `gnomon compare`.
void expect_rows_compare(const path& job, const path& run, const std::vector<std::string>& axes,
                         std::size_t rows_expected)
{
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), rows_expected);
    // The usual lane compares every third.
    for (std::size_t i = 0; i < rows.size(); i += tests::in_lane(3U, 1U)) {
        const auto& row = rows[i];
        std::vector<std::string> arguments{"compare", job, "--case", row.at("case"), "--json"};
        for (const std::string& key : axes) {
            arguments.insert(arguments.end(), {"--set", key + "=" + row.at(key)});
        }
        const Ending ending = gnomon(arguments);
        SCOPED_TRACE(ending.command);
        ASSERT_EQ(ending.exit_code, 0) << ending.err;
        EXPECT_EQ(row.at("status"), "done");
        expect_row_compares(row, Json::parse(ending.out));
    }
}

TEST(Sweep, GivesWhatCompareGives)
{
    const TemporaryFolder folder;
    const std::size_t sample = tests::in_lane<std::size_t>(10, 120);
    const path job = folder.write("job.toml", two_lights + fmt::format(R"(
[sweep]
sample = {}
seed = 5
"shadow_map.resolution" = [16, 40]
"shadow_map.depth_format" = ["d24", "d16", "d32f", "u8"]
"shadow_map.fit" = ["scene", "camera"]
"shadow_map.reversed" = [false, true]
"shadow_map.cull" = ["none", "front", "back"]
"lookup.filter" = ["nearest", "linear", "hardware", "pcf3", "pcf7"]
"lookup.outside" = ["lit", "shadowed", "clamp"]
"bias.slope" = [0, 0.002]
"bias.normal_texels" = [0, 1.5]
"bias.constant" = [0, 0.001, -0.01, 0.05]
)",
                                                                       sample));
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--no-keep-pixels"}));
    expect_rows_compare(job, run,
                        {"shadow_map.resolution", "shadow_map.depth_format", "shadow_map.fit",
                         "shadow_map.reversed", "shadow_map.cull", "lookup.filter",
                         "lookup.outside", "bias.slope", "bias.normal_texels", "bias.constant"},
                        sample);
}

TEST(Sweep, GivesWhatCompareGivesForBiasesOfOneCurve)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights + "[sweep]\n"
                                                           "\"lookup.filter\" = [\"pcf3\"]\n"
                                                           "\"bias.slope\" = [0.001]\n"
                                                           "\"bias.constant\" = [0.02, 0]\n");
    const path run = folder.path() / "run";
    const Ending ending =
        swept(sweep(job, run, {"--no-keep-pixels", "--set", "shadow_map.resolution=24"}));
    EXPECT_THAT(ending.out, HasSubstr("4 of 4 configurations done"));
    EXPECT_THAT(ending.out, HasSubstr("1 scene, 2 truths, 2 receiver passes, 2 shadow maps, "
                                      "2 lookup passes, 2 bias curves"));
    const std::vector<std::string> axes{"shadow_map.resolution", "lookup.filter", "bias.slope",
                                        "bias.constant"};
    expect_rows_compare(job, run, axes, 4);
}

TEST(Sweep, GivesWhatCompareGivesForColourFormats)
{
    const TemporaryFolder folder;
    const path job = folder.write(
        "job.toml", two_lights + "[sweep]\n"
                                 "\"shadow_map.depth_format\" = [\"r32f\", \"r16f\", \"rgba8\"]\n"
                                 "\"lookup.filter\" = [\"nearest\", \"pcf3\"]\n"
                                 "\"bias.constant\" = [0.01, 0]\n");
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--no-keep-pixels", "--set", "shadow_map.resolution=24"}));
    expect_rows_compare(
        job, run,
        {"shadow_map.resolution", "shadow_map.depth_format", "lookup.filter", "bias.constant"}, 24);
}

TEST(Sweep, GivesWhatCompareGivesWhereTheLookupIsMovedAndBiasesAreBelowZero)
{
    const TemporaryFolder folder;
    const path job =
        folder.write("job.toml", two_lights + "[sweep]\n"
                                              "\"bias.slope\" = [0.002, -0.002]\n"
                                              "\"bias.constant\" = [0.05, 0, -0.01]\n");
    const path run = folder.path() / "run";
    swept(sweep(job, run,
                {"--no-keep-pixels", "--set", "shadow_map.resolution=16", "--set",
                 "lookup.filter=pcf3", "--set", "lookup.outside=shadowed", "--set",
                 "bias.normal_texels=1.5"}));
    expect_rows_compare(job, run,
                        {"shadow_map.resolution", "lookup.filter", "lookup.outside",
                         "bias.normal_texels", "bias.slope", "bias.constant"},
                        12);
}

TEST(Sweep, GivesWhatCompareGivesForTheSixMapsOfAPointLight)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", R"(
scene.builtin = "lamp-room"
image.width = 64
image.height = 36
bias.normal_texels = 0.5
[[case]]
name = "lamp"
[sweep]
"shadow_map.resolution" = [16, 40]
"lookup.filter" = ["nearest", "pcf3", "hardware"]
"bias.constant" = [0.01, 0]
)");
    const path run = folder.path() / "run";
    const Ending ending = swept(sweep(job, run, {"--no-keep-pixels"}));
    EXPECT_THAT(ending.out, HasSubstr("12 of 12 configurations done"));
    EXPECT_THAT(ending.out, HasSubstr("1 scene, 1 truth, 1 receiver pass, 2 shadow maps, "));
    expect_rows_compare(job, run, {"shadow_map.resolution", "lookup.filter", "bias.constant"}, 12);
}

TEST(Sweep, GivesWhatCompareGivesForMethodsThatShareAMap)
{
    for (const char* const methods : {"\"vsm\", \"depth\"", "\"depth\", \"vsm\""}) {
        const TemporaryFolder folder;
        const path job = folder.write(
            "job.toml", two_lights + fmt::format("[lookup]\nfilter = \"linear\"\n[sweep]\n"
                                                 "\"method.name\" = [{}]\n"
                                                 "\"bias.constant\" = [0.02, 0]\n",
                                                 methods));
        const path run = folder.path() / "run";
        const Ending ending =
            swept(sweep(job, run, {"--no-keep-pixels", "--set", "shadow_map.resolution=24"}));
        EXPECT_THAT(ending.out, HasSubstr("2 shadow maps, 2 prefilter passes, 4 lookup passes"));
        expect_rows_compare(job, run, {"shadow_map.resolution", "method.name", "bias.constant"}, 8);
    }
}

TEST(Sweep, GivesWhatCompareGivesForMethodsWithOtherMapsOrNone)
{
    for (const char* const methods : {"\"depth\", \"primitive_id\", \"shadow_volumes\"",
                                      "\"shadow_volumes\", \"primitive_id\", \"depth\""}) {
        const TemporaryFolder folder;
        const path job = folder.write(
            "job.toml", two_lights + fmt::format("[sweep]\n\"method.name\" = [{}]\n", methods));
        const path run = folder.path() / "run";
        const Ending ending = swept(sweep(job, run, {"--no-keep-pixels"}));
        // For each light: a map of depths, one with triangles too, and none.
        EXPECT_THAT(ending.out, HasSubstr("4 shadow maps, 6 lookup passes"));
        expect_rows_compare(job, run, {"method.name"}, 6);
    }
}

TEST(Sweep, HasTheKeptPixelsOfEveryMethodReported)
{
    const TemporaryFolder folder;
    const path job =
        folder.write("job.toml", two_lights + "[sweep]\n\"method.name\" = [\"depth\", \"vsm\", "
                                              "\"primitive_id\", \"shadow_volumes\"]\n");
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--keep-pixels"}));
    const Ending ending = gnomon({"report", run});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("pixels of 8 configurations"));
    EXPECT_THAT(ending.err, Not(HasSubstr("left out")));
}

TEST(Sweep, HasItsPixelsComputedWhenAReportAsksForThem)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--axis", "bias.constant=0,0.02", "--no-keep-pixels"}));
    EXPECT_EQ(kept_images(run), 0U);
    const std::string id = csv_rows(run / "results.csv").at(1).at("id");
    // The page refuses pixels whose counts are not those of the results.
    const Ending ending = gnomon({"report", run, "--configuration", id});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_THAT(ending.out, HasSubstr("pixels of 1 configuration\n"));
    EXPECT_EQ(kept_images(run), 1U);
    expect_refused(gnomon({"report", run, "--configuration", "0123"}), 2,
                   "it has no measured configuration 0123");
}

TEST(Sweep, GivesTheSameBytesWhetherItKeepsPixelsOrNot)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const std::vector<std::string> axes{"--axis", "bias.constant=0,0.001,0.02",
                                        "--axis", "bias.slope=0,0.01",
                                        "--axis", "lookup.filter=pcf3,linear"};
    const path kept = folder.path() / "kept";
    const path bare = folder.path() / "bare";
    swept(sweep(job, kept, with(axes, {"--keep-pixels"})));
    swept(sweep(job, bare, axes)); // more than twenty keep the best and the worst of each case
    EXPECT_EQ(kept_images(kept), 24U);
    EXPECT_EQ(kept_images(bare), 4U);
    expect_same(RunCsv{kept}, RunCsv{bare});
    for (const auto& image : std::filesystem::directory_iterator{bare / "pixels"}) {
        if (image.path().extension() == ".exr") {
            EXPECT_EQ(text_of(image.path()), text_of(kept / "pixels" / image.path().filename()))
                << image.path();
        }
    }
    for (const auto& row : csv_rows(kept / "results.csv")) {
        EXPECT_TRUE(std::filesystem::exists(kept / "pixels" / (row.at("id") + ".exr")))
            << row.at("id");
    }
}

TEST(Sweep, GivesTheSameBytesWhetherItIsVerifiedOrNot)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const std::vector<std::string> axes{"--axis", "lookup.filter=nearest,pcf3,hardware", "--axis",
                                        "bias.constant=0,0.001,0.02", "--no-keep-pixels"};
    const path plain = folder.path() / "plain";
    const path verified = folder.path() / "verified";
    EXPECT_THAT(swept(sweep(job, plain, axes)).out, Not(HasSubstr("verified")));
    const RunCsv before{plain};
    const Ending ending = swept(sweep(job, verified, with(axes, {"--verify"})));
    EXPECT_THAT(ending.out, HasSubstr("\n  verified: 6 of 6 bias curves, 0 of "));
    expect_same(RunCsv{verified}, before);
    // Earlier results are verified too, once.
    const Ending later = swept(sweep(job, plain, with(axes, {"--verify"})));
    EXPECT_THAT(later.out, HasSubstr(" 6 lookup passes, 6 bias curves\n  verified: 6 of 6 bias"));
    expect_same(RunCsv{plain}, before);
    EXPECT_THAT(swept(sweep(job, plain, with(axes, {"--verify"}))).out,
                HasSubstr("now: nothing was left to do\n  verified: 6 of 6 bias curves, 0 of "));
}

TEST(Sweep, GivesTheSameBytesForAnyNumberOfThreadsAndShards)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const std::vector<std::string> axes{"--axis",          "shadow_map.resolution=16,24,32",
                                        "--axis",          "lookup.filter=nearest,hardware",
                                        "--axis",          "bias.constant=0,0.001,0.02",
                                        "--no-keep-pixels"};
    const path whole = folder.path() / "1";
    swept(sweep(job, whole, with(axes, {"--threads", "1"})));
    const RunCsv expected{whole};
    for (const char* const threads : {"2", "7"}) {
        SCOPED_TRACE(threads);
        const path run = folder.path() / threads;
        swept(sweep(job, run, with(axes, {"--threads", threads})));
        expect_same(RunCsv{run}, expected);
    }
    const path all = folder.path() / "all";
    std::vector<std::string> merge{"merge", all};
    std::size_t rows = 0;
    for (int shard = 1; shard <= 5; ++shard) {
        const path part = folder.path() / fmt::format("part{}", shard);
        swept(sweep(job, part, with(axes, {"--shard", fmt::format("{}/5", shard)})));
        merge.push_back(part);
        rows += csv_rows(part / "results.csv").size();
        EXPECT_LT(csv_rows(part / "results.csv").size(), 36U) << shard;
    }
    EXPECT_EQ(rows, 36U);
    swept(merge);
    expect_same(RunCsv{all}, expected);
}

} // namespace
} // namespace gnomon::testing
