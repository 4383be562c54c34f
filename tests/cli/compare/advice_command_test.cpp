// The predictions for remedies and views hold.

#include "child_process.hpp"
#include "lane.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Json = nlohmann::json;

Json compared(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "compare");
    arguments.emplace_back("--json");
    const Ending ending = gnomon(small(std::move(arguments)));
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err;
    return Json::parse(ending.out);
}

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// The options that change a job as a fragment of a job file does.
std::vector<std::string> settings_of(const Json& keys)
{
    std::vector<std::string> words;
    for (const std::string& key : keys.get<std::vector<std::string>>()) {
        words.insert(words.end(), {"--set", key});
    }
    return words;
}

std::string vector_text(const Json& vector)
{
    return fmt::format("[{}, {}, {}]", vector[0].get<double>(), vector[1].get<double>(),
                       vector[2].get<double>());
}

/// Expects that each remedy, run as a job of its own, leaves the predicted errors.
/// @return  the number of remedies.
std::size_t expect_remedies_kept(const std::vector<std::string>& job)
{
    const Json result = compared(with(job, {"--advise"}));
    std::size_t tried = 0;
    for (const Json& remedy : result.at("remedies")) {
        if (remedy.at("keys")[0].get<std::string>().starts_with("#")) {
            continue; // of the scene, not of the job
        }
        const Json measured = compared(with(job, settings_of(remedy.at("keys"))));
        const std::string told = job[1] + ": " + remedy.at("toml").get<std::string>();
        for (const char* const name :
             {"false_shadow", "false_lit", "shadow_amount", "light_amount", "softening"}) {
            EXPECT_EQ(measured.at(name), remedy.at(name)) << name << " of " << told;
        }
        ++tried;
    }
    return tried;
}

TEST(Remedies, LeaveWhatIsSaid)
{
    EXPECT_GT(expect_remedies_kept({"--builtin", "sphere-plane"}), 3U);
    EXPECT_GT(expect_remedies_kept({"--builtin", tests::in_lane("wall", "yard"), "--set",
                                    "shadow_map.resolution=256", "--set", "bias.constant_m=0.5"}),
              1U);
}

TEST(LongRemedies, LeaveWhatIsSaidOnTwentyJobs)
{
    std::size_t tried = 0;
    for (const char* const scene : {"sphere-plane", "sphere-cube", "wall", "fence", "room", "yard",
                                    "playground", "terrain", "columns", "two-distances"}) {
        for (const char* const setting : {"bias.constant=0", "shadow_map.resolution=256"}) {
            tried += expect_remedies_kept({"--builtin", scene, "--set", setting});
        }
    }
    EXPECT_GT(tried, 60U);
}

TEST(Remedies, ComeBeforeCausesAndTheRecommendedBiasSurvivesAnotherPicture)
{
    const std::vector<std::string> job{"--builtin", "sphere-plane"};
    const Json result = compared(job);
    const auto findings = result.at("findings").get<std::vector<std::string>>();
    ASSERT_GE(findings.size(), 3U);
    EXPECT_THAT(findings[0], HasSubstr("of the lit surface shadows itself (acne)"));
    EXPECT_THAT(findings[1], StartsWith("bias.constant = "));
    EXPECT_THAT(findings[1], HasSubstr("of the surface wrong, in place of"));
    EXPECT_THAT(findings, Contains(HasSubstr("of the error is acne, which this bias cures")));
    const double bias = result.at("bias_curve").at("recommended").at("bias").get<double>();
    // 0.2387, the bias with the fewest errors in the first picture, leaves no shadow in the second.
    const Json lower = compared(with(job, {"--set", "scene.sphere-plane.sphere_height_m=2", "--set",
                                           fmt::format("bias.constant={}", bias)}));
    EXPECT_LT(lower.at("false_lit_rate").get<double>(), 0.02);
}

TEST(Remedies, AreInTheSummaryOfAReport)
{
    const TemporaryFolder folder;
    const std::string run = (folder.path() / "run").string();
    EXPECT_EQ(gnomon(small({"compare", "--builtin", "sphere-plane", "--out", run})).exit_code, 0);
    EXPECT_EQ(gnomon({"report", run, "--no-figures"}).exit_code, 0);
    const std::string summary = text_of(folder.path() / "run" / "summary.md");
    EXPECT_THAT(summary, HasSubstr("| remedy | wrong pixels | map | texels read | known from |"));
    EXPECT_THAT(summary, HasSubstr("| bias.constant = "));
}

TEST(Remedies, OfAcneAreABiasBeforeALargerMap)
{
    const Json result = compared({"--builtin", "sphere-cube", "--set", "bias.constant=0", "--set",
                                  "bias.slope=0", "--advise"});
    const Json& first = result.at("remedies")[0];
    for (const std::string& key : first.at("keys").get<std::vector<std::string>>()) {
        EXPECT_THAT(key, Not(HasSubstr("resolution"))) << first;
    }
}

TEST(Remedies, OfAMethodWithoutACurveAreReruns)
{
    const std::vector<std::string> job{
        "--builtin", "sphere-plane",
        "--set",     "method.name=pcss",
        "--set",     "bias.constant=0",
        "--set",     "bias.slope=0",
        "--set",     tests::in_lane("shadow_map.resolution=128", "shadow_map.resolution=512")};
    const Json result = compared(with(job, {"--advise"}));
    ASSERT_FALSE(result.at("remedies").empty());
    const Json& first = result.at("remedies")[0];
    EXPECT_EQ(first.at("measured_by"), "rerun");
    const Json measured = compared(with(job, settings_of(first.at("keys"))));
    EXPECT_EQ(measured.at("false_shadow"), first.at("false_shadow"));
    EXPECT_EQ(measured.at("light_amount"), first.at("light_amount"));
    EXPECT_LT(first.at("false_shadow").get<int>(), result.at("false_shadow").get<int>() / 10)
        << "acne by a bias of 0, which a bias cures";
}

TEST(Remedies, TryTheOffsetThatIsAtFaultFirst)
{
    // In a reversed map depths fall with the distance: this offset draws the casters nearer.
    const Json result = compared(
        {"--builtin", tests::in_lane("sphere-plane", "yard"), "--set", "shadow_map.reversed=true",
         "--set", "shadow_map.depth_format=d32f", "--set", "bias.constant=0", "--set",
         "bias.polygon_offset_factor=2", "--set", "bias.polygon_offset_units=2", "--advise"});
    EXPECT_EQ(result.at("remedies")[0].at("keys"),
              (Json{"bias.polygon_offset_factor = -2", "bias.polygon_offset_units = -2"}));
}

TEST(Remedies, ResolveAFewThingsOnAWideFloorInAsManyBytes)
{
    const TemporaryFolder folder;
    const auto scene = folder.path() / "floor.obj";
    // A plate of half a metre over a floor of 400 m.
    std::ofstream{scene} << "o floor\nv -200 0 -200\nv -200 0 200\nv 200 0 200\nv 200 0 -200\n"
                            "f 1 2 3 4\no plate\nv -0.25 0.2 -0.25\nv -0.25 0.2 0.25\n"
                            "v 0.25 0.2 0.25\nv 0.25 0.2 -0.25\nf 5 6 7 8\n";
    const Json result = compared(
        {scene.string(), "--set", "camera.eye=[0.7, 0.6, 0.9]", "--set", "camera.target=[0, 0, 0]",
         "--set", "light.direction=[-0.4, -1, -0.3]", "--set", "bias.constant=0", "--advise"});
    const auto tries = [&](const std::string& key) {
        const Json& remedies = result.at("remedies");
        return std::any_of(remedies.begin(), remedies.end(), [&](const Json& remedy) {
            return remedy.at("keys").dump().find(key) != std::string::npos;
        });
    };
    EXPECT_TRUE(tries("shadow_map.layout = \\\"cascades\\\"")) << result.at("remedies");
    EXPECT_TRUE(tries("shadow_map.half_extent = ")) << result.at("remedies");
    const double blocked = result.at("pixels").at("blocked").get<double>();
    for (const Json& remedy : result.at("remedies")) {
        EXPECT_LE(remedy.at("light_amount").get<double>(), blocked / 2) << remedy;
    }
}

TEST(Remedies, NameNearAndFarWhereTheyAreTheCause)
{
    const Json result =
        compared({"--builtin", "sphere-plane", "--set", "shadow_map.near=1e-8", "--advise"});
    const auto findings = result.at("findings").get<std::vector<std::string>>();
    EXPECT_THAT(findings[0], HasSubstr("the map cannot tell depths apart, for with near = 1e-08"));
    EXPECT_THAT(findings[1], StartsWith("shadow_map.near = \"auto\""));
    EXPECT_THAT(findings[1], HasSubstr("a step of the stored depth is then"));
    EXPECT_EQ(findings[2], "The error is due to the map's near and far planes.");
    const Json& first = result.at("remedies")[0];
    EXPECT_LT(first.at("depth_step_m").get<double>(),
              first.at("depth_step_before_m").get<double>() / 1000);
}

/// A box over a floor, this far from the origin.
std::string far_scene(double x)
{
    std::string obj = "o floor\n";
    for (const auto& [vx, vz] : {std::pair{-4, -4}, {-4, 4}, {4, 4}, {4, -4}}) {
        obj += fmt::format("v {} 0 {}\n", x + vx, vz);
    }
    obj += "f 1 2 3 4\no plate\n";
    for (const auto& [vx, vz] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
        obj += fmt::format("v {} {} {}\n", x + vx, 0.25, vz);
    }
    return obj + "f 5 6 7 8\n";
}

TEST(Remedies, MoveTheOriginWhereMatricesAreTheCause)
{
    const TemporaryFolder folder;
    const auto scene = folder.path() / "far.obj";
    std::ofstream{scene} << far_scene(200'000);
    const std::vector<std::string> job{scene.string(),
                                       "--set",
                                       "shadow_map.depth_format=d32f",
                                       "--set",
                                       "shadow_map.resolution=4096",
                                       "--set",
                                       "camera.eye=[200003, 4, 5]",
                                       "--set",
                                       "camera.target=[200000, 0, 0]",
                                       "--set",
                                       "bias.constant_m=0.01"};
    EXPECT_EQ(compared(job).at("findings").back(),
              "The errors may come from float32 positions: the scene's centre is 200,000 units "
              "from its origin. `--advise` measures what an origin nearby leaves.");
    const Json result = compared(with(job, {"--advise"}));
    EXPECT_GT(result.at("precision_kinds").at("transform"),
              result.at("precision_kinds").at("format"));
    bool is_moved = false;
    for (const Json& advice : result.at("advice")) {
        const auto key = advice.at("keys")[0].get<std::string>();
        if (key.starts_with("# move the scene's origin to [")) {
            is_moved = true;
            EXPECT_LT(advice.at("false_lit").get<int>() + advice.at("false_shadow").get<int>(),
                      result.at("false_lit").get<int>() + result.at("false_shadow").get<int>());
        }
    }
    EXPECT_TRUE(is_moved) << result.at("advice");
    EXPECT_THAT(result.at("findings")[1].get<std::string>(),
                StartsWith("Moving the scene's origin to [200000, 0, 0] leaves "));
    EXPECT_THAT(
        result.at("findings")[2].get<std::string>(),
        HasSubstr(
            "float32 matrices and positions: the scene's centre is 200,000 units from its origin"));
}

TEST(Views, AreToldAndHoldTheRecommendedBias)
{
    const std::vector<std::string> job{"--builtin", "sphere-plane"};
    const Json result = compared(with(job, {"--advise", "--views", "2"}));
    ASSERT_EQ(result.at("views").size(), 3U);
    EXPECT_EQ(result.at("views")[0].at("name"), "own");
    EXPECT_EQ(result.at("bias_curve").at("recommended").at("views"), 3);
    const Json& remedy = result.at("remedies")[0];
    ASSERT_EQ(remedy.at("views").size(), 3U);
    EXPECT_THAT(result.at("findings")[1].get<std::string>(),
                HasSubstr("Over 3 views it leaves at most"));
    for (std::size_t i = 0; i < 3; ++i) {
        const Json& view = result.at("views")[i];
        const std::vector<std::string> there =
            with(job, {"--set", "camera.eye=" + vector_text(view.at("eye")), "--set",
                       "camera.target=" + vector_text(view.at("target"))});
        const Json now = compared(there);
        EXPECT_EQ(now.at("false_shadow"), view.at("now").at("false_shadow")) << i;
        EXPECT_EQ(now.at("false_lit"), view.at("now").at("false_lit")) << i;
        const Json mended = compared(with(there, settings_of(remedy.at("keys"))));
        EXPECT_EQ(mended.at("shadow_amount"), remedy.at("views")[i].at("shadow_amount")) << i;
        EXPECT_EQ(mended.at("light_amount"), remedy.at("views")[i].at("light_amount")) << i;
    }
}

TEST(Views, OfOtherLightsShareTheBiasInMetres)
{
    const Json result = compared({"--builtin", "yard", "--set", "shadow_map.near=auto", "--set",
                                  "shadow_map.far=auto", "--advise", "--lights", "2"});
    ASSERT_EQ(result.at("views").size(), 3U);
    for (const Json& remedy : result.at("remedies")) {
        if (remedy.at("bias").is_null() || remedy.at("measured_by") != "rerun") {
            continue;
        }
        EXPECT_THAT(remedy.at("keys").back().get<std::string>(), StartsWith("bias.constant_m = "));
        const Json& views = remedy.at("views");
        EXPECT_NE(views[0].at("bias"), views[1].at("bias")) << "other planes, other depth units";
    }
}

const char* const two_cases = R"([scene]
builtin = "wall"
[[case]]
name = "left"
camera.eye = [-3, 2, 6]
[[case]]
name = "right"
camera.eye = [3, 2, 6]
)";

TEST(Cases, AreNotLeftOutInSilence)
{
    const TemporaryFolder folder;
    const auto job = folder.path() / "job.toml";
    std::ofstream{job} << tests::in_lane("shadow_map.resolution = 256\n", "") << two_cases;
    for (const char* const command : {"compare", "tune"}) {
        const Ending ending = gnomon(small({command, job.string()}));
        EXPECT_THAT(ending.err, HasSubstr("the job's cases (left, right) are ignored")) << command;
    }
    const Json result = compared({job.string(), "--advise", "--all-cases"});
    ASSERT_EQ(result.at("views").size(), 3U);
    EXPECT_EQ(result.at("views")[1].at("name"), "left");
    EXPECT_EQ(result.at("views")[2].at("eye")[0], 3);
}

TEST(Cases, ThatChangeMoreThanTheViewAreRefused)
{
    const TemporaryFolder folder;
    const auto job = folder.path() / "job.toml";
    std::ofstream{job} << two_cases << "bias.constant = 0.01\n";
    expect_refused(gnomon(small({"compare", job.string(), "--advise", "--all-cases"})), 2,
                   "case right changes bias.constant");
    expect_refused(gnomon(small({"tune", "--builtin", "wall", "--all-cases"})), 2,
                   "the job defines no [[case]]");
    expect_refused(gnomon(small({"compare", "--builtin", "wall", "--views", "2"})), 2,
                   "need --advise");
    expect_refused(gnomon(small({"tune", "--builtin", "wall", "--views", "65"})), 2, "--views");
}

TEST(TuneOutput, IsAsMuchAsIsAskedFor)
{
    const std::vector<std::string> job{"tune", "--builtin",          "wall", "--max-resolution",
                                       "256",  "--max-false-shadow", "50%",  "--max-false-lit",
                                       "50%"};
    const Ending quiet = gnomon(small(with(job, {"--quiet"})));
    expect_done(quiet);
    EXPECT_THAT(quiet.out, StartsWith("[shadow_map]\nresolution = 256\n"));
    EXPECT_THAT(quiet.out, Not(HasSubstr("considered")));
    const Ending plain = gnomon(small(job));
    EXPECT_THAT(plain.out, HasSubstr("shadow_map = { resolution = 256, depth_format = \"d16\""));
    const Ending verbose = gnomon(small(with(job, {"--verbose"})));
    EXPECT_THAT(verbose.out, HasSubstr("VK_FORMAT_D16_UNORM"));
    EXPECT_THAT(verbose.out, HasSubstr("DXGI_FORMAT_D16_UNORM"));
    EXPECT_THAT(verbose.out, HasSubstr("GL_DEPTH_COMPONENT16"));
    EXPECT_THAT(verbose.out, HasSubstr(quiet.out));
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    EXPECT_GT(lines(verbose.out), lines(plain.out));
    EXPECT_GT(lines(verbose.err), lines(plain.err));
}

} // namespace
} // namespace gnomon::testing
