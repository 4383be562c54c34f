// `gnomon sweep` over scene files that cannot be read, and over equal ones.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
    // Once the file exists, its configuration counts as missing: no --retry is needed.
    folder.write("a.obj", ground + "v 0 1 0\nv 1 1 0\nv 0 1 1\nf 4 6 5\n");
    EXPECT_THAT(gnomon(arguments).out, StartsWith("2 of 3 configurations done, 1 failed: "));
}

TEST(Sweep, KeepsTheNotesOnEachScenesFileForItsReport)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "image.width = 32\nimage.height = 18\n");
    const std::string ground = "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n";
    folder.write("plain.obj", ground);
    folder.write("glass.mtl", "newmtl glass\nKd 1 1 1\nd 0.5\n");
    folder.write("glass.obj", "mtllib glass.mtl\nusemtl glass\n" + ground + "l 1 2\n");
    const path run = folder.path() / "run";
    swept(sweep(job, run, {"--axis", "scene.file=plain.obj,glass.obj"}));
    const Ending compared = gnomon({"compare", (folder.path() / "glass.obj").string(), "--json"});
    EXPECT_THAT(compared.out, HasSubstr("\"kind\": \"alpha_blend\""));
    EXPECT_EQ(gnomon({"report", run.string(), "--no-figures"}).exit_code, 0);
    const std::string summary = text_of(run / "summary.md");
    EXPECT_THAT(summary, HasSubstr("- note: 1 material is transparent, but taken as solid: 1 "
                                   "object (in 1 of 2 configurations)\n"));
    EXPECT_THAT(summary, HasSubstr("- note: points and lines cast no shadow, and one is left out"));
}

TEST(Sweep, NamesEachRowsOwnFileOfEqualContent)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "image.width = 32\nimage.height = 18\n"
                                              "[[case]]\nname = \"first\"\n"
                                              "scene.file = \"a.obj\"\nbias.constant = 0.001\n"
                                              "[[case]]\nname = \"second\"\n"
                                              "scene.file = \"b.obj\"\nbias.constant = 0.002\n");
    const std::string text = "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nf 1 3 2\n";
    folder.write("a.obj", text);
    folder.write("b.obj", text);
    const path run = folder.path() / "run";
    swept(sweep(job, run));
    const auto rows = csv_rows(run / "results.csv");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("curve"), rows[1].at("curve"));
    EXPECT_THAT(rows[0].at("scene.file"), HasSubstr("a.obj"));
    EXPECT_THAT(rows[1].at("scene.file"), HasSubstr("b.obj"));
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
        const path run = folder.path() / fmt::format("run{}", pixels);
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
    // Two shards do not either.
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
    scene::test::QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],)";
    if (is_lit) {
        gltf.more += R"("extensionsUsed":["KHR_lights_punctual"],)"
                     R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"directional"}]}},)";
    }
    gltf.nodes = fmt::format(
        R"([{{"name":"quad","mesh":0}},{{"camera":0,"translation":[0.5,0.5,{}]}},)"
        R"({{"name":"light"{}}}])",
        distance_m, is_lit ? R"(,"extensions":{"KHR_lights_punctual":{"light":0}})" : "");
    gltf.roots = "[0,1,2]";
    return gltf.text();
}

/// A row without its place in the sweep.
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
            if (!tests::runs_full_tests() && (i / 2 == 1) != (pixels[2] == 'n')) {
                continue; // the usual lane tries each file once
            }
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
    // `compare` gives the same name.
    const path single = folder.path() / "single";
    swept({"compare", job, "--set", fmt::format("scene.file={}/lit.gltf", folder.path().string()),
           "--set", "bias.constant=0", "--out", single});
    EXPECT_EQ(csv_rows(single / "results.csv").at(0).at("id"),
              csv_rows(run / "results.csv").at(4).at("id"));
    // If the job sets both, the files are equal.
    const Ending same = swept(sweep(job, folder.path() / "same",
                                    with(axes, {"--set", "camera.eye=[0.5, 0.5, 5]", "--set",
                                                "light.direction=[-1, -1, -1]"})));
    EXPECT_THAT(same.out, HasSubstr("now: 1 scene, 1 truth, "));
    EXPECT_THAT(same.out, HasSubstr("\n  6 configurations are the same as an earlier one"));
}

} // namespace
} // namespace gnomon::testing
