#include "child_process.hpp"

#include "scene_file_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> tiny(std::vector<std::string> arguments)
{
    for (const char* const setting :
         {"image.width=32", "image.height=32", "shadow_map.resolution=64"}) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    return arguments;
}

Ending sweep_scene(const std::string& scene, const std::string& folder,
                   std::vector<std::string> more = {})
{
    std::vector<std::string> arguments{
        "sweep",   "--builtin",       scene, "--out", folder, "--axis", "bias.constant=0.1,0.2",
        "--quiet", "--no-keep-pixels"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return gnomon(tiny(arguments));
}

TEST(KeptFiles, ACaseIsReplacedOnlyWhenAsked)
{
    const TemporaryFolder folder;
    const std::string place = folder.path();
    folder.write("case.toml", "mine");
    expect_refused(gnomon(tiny({"compare", "--builtin", "wall", "--export-case", place})), 2,
                   place + "/case.toml: the file exists: name another folder, or pass --force");
    EXPECT_EQ(text_of(folder.path() / "case.toml"), "mine");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "mesh.glb"));
    EXPECT_EQ(
        gnomon(tiny({"compare", "--builtin", "wall", "--export-case", place, "--force"})).exit_code,
        0);
    EXPECT_THAT(text_of(folder.path() / "case.toml"), HasSubstr("name = \"wall\""));
    // Gnomon's own files may have been edited since.
    expect_refused(gnomon(tiny({"compare", "--builtin", "wall", "--export-case", place})), 2,
                   "pass --force");
}

TEST(KeptFiles, AMeshOfACaseIsReplacedOnlyWhenAsked)
{
    const TemporaryFolder folder;
    folder.write("mesh.glb", "mine");
    expect_refused(gnomon(tiny({"compare", "--builtin", "wall", "--export-case", folder.path()})),
                   2, "mesh.glb: the file exists");
    EXPECT_EQ(text_of(folder.path() / "mesh.glb"), "mine");
}

TEST(KeptFiles, ARunOfAnotherSceneIsReplacedOnlyWhenAsked)
{
    const TemporaryFolder folder;
    const std::string run = folder.path() / "run";
    expect_done(sweep_scene("wall", run));
    const std::string results = text_of(run + "/results.csv");
    expect_refused(
        sweep_scene("yard", run), 2,
        "run: holds results of another scene, wall: name another folder, or pass --force");
    EXPECT_EQ(text_of(run + "/results.csv"), results);
    EXPECT_THAT(sweep_scene("wall", run).out,
                HasSubstr("nothing was left to do")); // the plan is kept too
    expect_done(sweep_scene("yard", run, {"--force"}));
    EXPECT_THAT(text_of(run + "/results.csv"), HasSubstr("yard"));
}

TEST(KeptFiles, ARunOfTheSameSceneGoesOnWithOtherAxes)
{
    const TemporaryFolder folder;
    const std::string run = folder.path() / "run";
    expect_done(sweep_scene("wall", run));
    expect_done(sweep_scene("wall", run, {"--axis", "bias.slope=0,1"}));
}

TEST(KeptFiles, AComparisonReplacesASweepOrAnotherSceneOnlyWhenAsked)
{
    const TemporaryFolder folder;
    const std::string swept = folder.path() / "swept";
    expect_done(sweep_scene("wall", swept));
    expect_refused(gnomon(tiny({"compare", "--builtin", "wall", "--out", swept})), 2,
                   "holds a sweep, which this would replace: name another folder, or pass "
                   "--force");
    const std::string run = folder.path() / "run";
    expect_done(gnomon(tiny({"compare", "--builtin", "wall", "--out", run})));
    expect_done(gnomon(tiny({"compare", "--builtin", "wall", "--out", run})));
    expect_refused(gnomon(tiny({"compare", "--builtin", "yard", "--out", run})), 2,
                   "holds results of another scene, wall");
    expect_done(gnomon(tiny({"compare", "--builtin", "yard", "--out", run, "--force"})));
}

TEST(KeptFiles, OutputsAreNamedForWhatTheyHold)
{
    const TemporaryFolder folder;
    const std::string place = folder.path();
    const std::vector<std::vector<std::string>> refused{
        {"compare", "--builtin", "wall", "--picture", place + "/x.jpg"},
        {"compare", "--builtin", "wall", "--aov", place + "/x.png"},
        {"compare", "--builtin", "wall", "--depth-map", place + "/x.png"},
        {"compare", "--builtin", "wall", "--heat-map", "cause=" + place + "/x.exr"},
        {"depth", "--plot", place + "/x.jpg"},
        {"depth", "--csv", place + "/x.png"},
        {"figure", "bias-curve", place, "-o", place + "/x.jpg"},
        {"gate", place, "--baseline", place + "/b.json", "--junit", place + "/x.json"},
        {"baseline", "save", place, "--baseline", place + "/x.toml"},
        {"init", place + "/x.json"}};
    for (const auto& arguments : refused) {
        expect_refused(gnomon(arguments), 2, "; name it so");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(KeptFiles, AnOutputMayBeAPipeWhoseReaderGetsAllOfIt)
{
    const TemporaryFolder folder;
    const std::string pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string read;
    std::thread reader{[&] { read = text_of(pipe); }};
    const Ending ending = gnomon(tiny({"compare", "--builtin", "wall", "--picture", pipe}));
    reader.join();
    expect_done(ending);
    EXPECT_EQ(read.substr(1, 3), "PNG");
}

} // namespace
} // namespace gnomon::testing
