// `gnomon plan`, `gnomon run-unit` and `gnomon merge` of its files.

#include "child_process.hpp"
#include "lane.hpp"
#include "run_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;
using ::testing::HasSubstr;
using ::testing::SizeIs;

const std::vector<std::string> axes{"--axis", "shadow_map.resolution=16,20,24",
                                    "--axis", "bias.slope=0,1",
                                    "--axis", "bias.constant=0,0.001,0.02"};

/// The plan's lines.
std::vector<Json> plan(const path& job, const path& file, const std::string& units,
                       const std::vector<std::string>& more = axes)
{
    const Ending ending = gnomon(with({"plan", job, "--units", units, "--out", file}, more));
    expect_done(ending);
    std::vector<Json> lines;
    std::istringstream text{text_of(file)};
    for (std::string line; std::getline(text, line);) {
        lines.push_back(Json::parse(line));
    }
    return lines;
}

Ending run_unit(const path& plan_file, const std::string& unit, const path& units,
                const Start& start = {})
{
    return gnomon({"run-unit", plan_file, unit, "--out", units, "--quiet"}, start);
}

TEST(Plan, HasUnitsOfAllConfigurationsAndNamesWhatTheyRead)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const auto lines = plan(job, folder.path() / "plan.jsonl", "5");
    ASSERT_THAT(lines, SizeIs(6));
    EXPECT_EQ(lines[0].at("configurations"), 36);
    EXPECT_EQ(lines[0].at("units"), 5);
    ASSERT_THAT(lines[0].at("scenes"), SizeIs(1));
    const std::string scene = lines[0].at("scenes")[0].at("hash");
    EXPECT_EQ(scene.size(), 16U);
    std::uint64_t configurations = 0;
    double seconds = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].at("number"), i);
        EXPECT_EQ(lines[i].at("scenes"), Json::array({scene}));
        configurations += lines[i].at("configurations").get<std::uint64_t>();
        seconds += lines[i].at("estimated_seconds").get<double>();
    }
    EXPECT_EQ(configurations, 36U);
    EXPECT_DOUBLE_EQ(lines[0].at("estimated_seconds").get<double>(), seconds);
    EXPECT_EQ(gnomon(with({"plan", job, "--units", "5"}, axes)).out,
              text_of(folder.path() / "plan.jsonl"))
        << "the same plan each time";
}

TEST(Plan, RefusesWhatASweepRefuses)
{
    const TemporaryFolder folder;
    expect_refused(gnomon({"plan", "--builtin", "wall", "--units", "0"}), 2, "--units");
    expect_refused(gnomon({"plan", "--builtin", "wall", "--axis", "bias=1"}), 2, "unknown key");
    expect_refused(gnomon({"plan", folder.write("job.toml", "scene.file = \"none.obj\"\n")}), 2,
                   "none.obj");
    expect_refused(gnomon({"plan", folder.write("e.toml", "renderer = \"three\"\n")}), 2,
                   "renderer");
    expect_refused(gnomon({"plan"}), 2, "no job");
}

TEST(RunUnit, OfAllUnitsMakesOneMachinesSweep)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path whole = folder.path() / "whole";
    swept(sweep(job, whole, with(axes, {"--no-keep-pixels"})));
    const path file = folder.path() / "plan.jsonl";
    const auto lines = plan(job, file, "4");
    const path units = folder.path() / "units";
    for (const char* const unit : {"3", "1", "4"}) {
        expect_done(run_unit(file, unit, units));
    }
    const Ending early = gnomon({"merge", folder.path() / "early", units});
    EXPECT_EQ(early.exit_code, incomplete);
    EXPECT_THAT(early.err, HasSubstr("1 of 4 units missing: 2; compute with"));
    expect_done(run_unit(file, lines[2].at("unit"), units)); // by its id
    const Ending known = run_unit(file, "2", units);
    expect_done(known);
    EXPECT_THAT(known.out, HasSubstr("configurations done before: "));
    EXPECT_EQ(entry_count(units), 4U) << "nothing else is left";
    expect_done(gnomon({"merge", folder.path() / "all", units}));
    expect_same(RunCsv{folder.path() / "all"}, RunCsv{whole});
}

TEST(RunUnit, WorksWhereverItIsStarted)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", "scene.file = \"plate.obj\"\n"
                                              "light.position = [0, 3, 1]\n"
                                              "camera.eye = [0, 2, 3]\n"
                                              "image.width = 32\nimage.height = 18\n");
    folder.write("plate.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\nv 1 1 0\nv 0 1 1\n"
                              "f 1 2 3 4\nf 5 6 7\n");
    const Ending whole = run({"sh", "-c",
                              fmt::format("cd '{}' && \"$0\" sweep job.toml --out whole "
                                          "--no-keep-pixels --axis shadow_map.resolution=16,20 && "
                                          "\"$0\" plan job.toml --units 2 --out plan.jsonl "
                                          "--axis shadow_map.resolution=16,20",
                                          folder.path().string()),
                              GNOMON_PROGRAM_PATH});
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    const path file = folder.path() / "plan.jsonl";
    std::filesystem::remove(job); // the plan has its text
    for (const char* const unit : {"1", "2"}) {
        expect_done(run_unit(file, unit, folder.path() / "units"));
    }
    expect_done(gnomon({"merge", folder.path() / "all", folder.path() / "units"}));
    expect_same(RunCsv{folder.path() / "all"}, RunCsv{folder.path() / "whole"});
    folder.write("plate.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nf 1 2 3\n");
    expect_refused(run_unit(file, "1", folder.path() / "others"), 2, "has the content");
    std::filesystem::remove(folder.path() / "plate.obj");
    expect_refused(run_unit(file, "1", folder.path() / "others"), 2, "could not be read here");
}

TEST(RunUnit, LeavesTheSameBytesWheneverItIsKilled)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.path() / "plan.jsonl";
    plan(job, file, "1");
    const path whole = folder.path() / "whole";
    const Ending ending = swept(sweep(job, whole, with(axes, {"--no-keep-pixels"})));
    const path units = folder.path() / "units";
    std::mt19937 random{8};
    const int kills = tests::in_lane(3, 20);
    std::string moments;
    for (int killed = 0, tries = 0; killed < kills && tries < 10 * kills; ++tries) {
        const auto moment_ms =
            static_cast<int>(random() % static_cast<std::uint64_t>(1 + 800 * ending.time_s));
        moments += fmt::format(" {}", moment_ms);
        Start start;
        start.while_running = [&](pid_t child) {
            std::this_thread::sleep_for(std::chrono::milliseconds{moment_ms});
            ::kill(child, SIGKILL);
        };
        const Ending tried = run_unit(file, "1", units, start);
        if (tried.signal == SIGKILL) {
            ++killed;
        } else {
            ASSERT_EQ(tried.exit_code, 0) << tried.err;
            std::filesystem::remove_all(units);
        }
    }
    SCOPED_TRACE("killed after" + moments + " ms");
    expect_done(run_unit(file, "1", units));
    EXPECT_EQ(entry_count(units), 1U) << "what was begun is gone";
    expect_done(gnomon({"merge", folder.path() / "all", units}));
    expect_same(RunCsv{folder.path() / "all"}, RunCsv{whole});
}

TEST(RunUnit, IsComputedBesideAProcessThatIsStopped)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.path() / "plan.jsonl";
    plan(job, file, "1");
    const path units = folder.path() / "units";
    Start start;
    start.while_running = [&](pid_t stopped) {
        wait_until([&] { return entry_count(units) > 0; });
        ::kill(stopped, SIGSTOP);
        expect_done(run_unit(file, "1", units));
        EXPECT_EQ(std::filesystem::exists(units), true);
        ::kill(stopped, SIGCONT);
    };
    expect_done(run_unit(file, "1", units, start)); // writes the same file again
    EXPECT_EQ(entry_count(units), 1U);
}

TEST(RunUnit, ReplacesAFileThatIsNotWholeAndRefusesOneOfAnotherPlan)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.path() / "plan.jsonl";
    const auto lines = plan(job, file, "4");
    const path units = folder.path() / "units";
    expect_done(run_unit(file, "1", units));
    const std::string first = lines[1].at("unit");
    const path unit = units / (first + ".unit");
    std::filesystem::resize_file(unit, 3'000);
    const Ending again = run_unit(file, "1", units);
    expect_done(again);
    EXPECT_THAT(again.out, HasSubstr("configurations done: "));
    const path other = folder.path() / "other.jsonl";
    const auto others = plan(job, other, "3");
    std::filesystem::copy_file(unit, units / (others[1].at("unit").get<std::string>() + ".unit"));
    expect_refused(run_unit(other, "1", units), 2, "is of plan");
    expect_done(run_unit(other, "1", folder.path() / "elsewhere"));
    expect_refused(gnomon({"merge", folder.path() / "all", unit, folder.path() / "elsewhere"}), 2,
                   "merge the units of one plan");
}

TEST(RunUnit, RefusesPlansThatAreNotItsOwn)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.path() / "plan.jsonl";
    plan(job, file, "2");
    expect_refused(run_unit(file, "3", folder.path()), 2, "by its number from 1 to 2");
    expect_refused(run_unit(job, "1", folder.path()), 2, "is not the plan of a sweep");
    expect_refused(run_unit(folder.path() / "none", "1", folder.path()), 2, "none");
    std::string text = text_of(file);
    const std::string kept = "\"keeps_normals\":false";
    text.replace(text.find(kept), kept.size(), "\"keeps_normals\":true");
    expect_refused(run_unit(folder.write("changed.jsonl", text), "1", folder.path()), 2,
                   "was edited");
}

TEST(RunUnit, EndsWithFiveWhereConfigurationsFail)
{
    const TemporaryFolder folder;
    const path job = folder.write("job.toml", two_lights);
    const path file = folder.path() / "plan.jsonl";
    const std::vector<std::string> contrary{"--axis", "shadow_map.near=0.1,90",
                                            "--set",  "shadow_map.far=50",
                                            "--axis", "shadow_map.resolution=16,20"};
    const path whole = folder.path() / "whole";
    const Ending ending = gnomon(sweep(job, whole, with(contrary, {"--no-keep-pixels"})));
    ASSERT_EQ(ending.exit_code, incomplete) << ending.err;
    plan(job, file, "2", contrary);
    const path units = folder.path() / "units";
    const Ending first = run_unit(file, "1", units);
    EXPECT_EQ(first.exit_code, incomplete);
    EXPECT_EQ(first.err, "gnomon: 4 configurations failed\n");
    EXPECT_EQ(run_unit(file, "1", units).exit_code, incomplete) << "it is known";
    expect_done(run_unit(file, "2", units));
    EXPECT_EQ(gnomon({"merge", folder.path() / "all", units}).exit_code, incomplete);
    expect_same(RunCsv{folder.path() / "all"}, RunCsv{whole});
}

} // namespace
} // namespace gnomon::testing
