#include "renderer/fake_renderer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// A wall on the ground, in few pixels.
std::vector<std::string> wall(const std::string& command, std::vector<std::string> more)
{
    std::vector<std::string> arguments{command};
    for (const char* const word :
         {"--builtin", "wall", "--set", "image.width=48", "--set", "image.height=36", "--set",
          "scene.wall.thickness_m=0.4", "--set", "camera.eye=[5, 4, 5]", "--set",
          "camera.target=[1, 0.5, 0]"}) {
        arguments.emplace_back(word);
    }
    arguments.insert(arguments.end(), std::make_move_iterator(more.begin()),
                     std::make_move_iterator(more.end()));
    return arguments;
}

Ending driven(const FakeRenderer& renderer, const std::string& command,
              std::vector<std::string> more, const Start& start)
{
    more.insert(more.end(), {"--renderer-command", renderer.command()});
    return gnomon(wall(command, std::move(more)), start);
}

Ending driven(const FakeRenderer& renderer, const std::string& command,
              std::vector<std::string> more)
{
    return driven(renderer, command, std::move(more), renderer.start());
}

/// The rows of a CSV file by column; no cell has an end of line.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv)
{
    std::istringstream lines{csv};
    std::vector<std::vector<std::string>> cells;
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> row{""};
        bool is_quoted = false;
        for (const char c : line) {
            if (c == '"') {
                is_quoted = !is_quoted;
            } else if (c == ',' && !is_quoted) {
                row.emplace_back();
            } else {
                row.back() += c;
            }
        }
        cells.push_back(std::move(row));
    }
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t i = 1; i < cells.size(); ++i) {
        std::map<std::string, std::string> row;
        for (std::size_t k = 0; k < cells[0].size(); ++k) {
            row[cells[0][k]] = cells[i].at(k);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

TEST(ComparedRenderer, IsJudgedAsACaseIs)
{
    const FakeRenderer renderer{"biased"};
    const Ending plain = driven(renderer, "compare", {"--json"});
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    const auto json = nlohmann::json::parse(plain.out);
    EXPECT_EQ(json.at("environment").at("gl_renderer"), "fake 1.0, rays in Python");
    EXPECT_EQ(json.at("evaluate").at("positions"), "image");
    EXPECT_EQ(json.at("job").at("engine.bias"), 0.0) << json.at("job").dump();
    EXPECT_EQ(json.at("job").at("engine.kind"), "hard");
    EXPECT_GT(json.at("false_shadow"), 0);
    const Ending biased = driven(renderer, "compare", {"--json", "--set", "engine.bias=0.001"});
    ASSERT_EQ(biased.exit_code, 0) << biased.err;
    EXPECT_EQ(nlohmann::json::parse(biased.out).at("false_shadow"), 0);
    renderer.expect_nothing_left();
}

TEST(ComparedRenderer, ThatDoesNotEndIsEndedAndItsFramesCount)
{
    const FakeRenderer renderer{"stays"};
    const Ending ending = driven(renderer, "compare", {"--json"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_THAT(ending.err, HasSubstr("close: it did not end within 5 s"));
    EXPECT_THAT(ending.err, HasSubstr("what it drew was complete before"));
    EXPECT_GT(nlohmann::json::parse(ending.out).at("pixels").at("blocked"), 0);
    renderer.expect_nothing_left();
}

TEST(ComparedRenderer, ExplainsWhatIsWrongWithItsKeys)
{
    const FakeRenderer renderer{"biased"};
    expect_refused(driven(renderer, "compare", {"--set", "engine.bios=1"}), 2,
                   "the nearest is engine.bias");
    expect_refused(driven(renderer, "compare", {"--set", "engine.bias=2"}), 2,
                   "must be a number from -1 to 1");
    expect_refused(driven(renderer, "compare", {"--set", "bias.slope=0.1"}), 2,
                   "cannot do it: bias.slope: rays have none");
    expect_refused(driven(renderer, "compare", {"--advise"}), 2,
                   "--advise is only for GL's shadows");
    expect_refused(gnomon({"compare", "--builtin", "wall", "--set", "engine.bias=1"}), 2,
                   "keys of [engine] are a renderer's own");
    renderer.expect_nothing_left();
}

TEST(ComparedRenderer, MustDrawEqualFramesTwice)
{
    const FakeRenderer renderer{"unequal"};
    expect_refused(driven(renderer, "compare", {}), 4,
                   "two equal requests gave frames that are not equal");
    renderer.expect_nothing_left();
}

TEST(JobFile, NamesARendererAndNeverACommand)
{
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& text, const std::string& words) {
        folder.write("job.toml", text + "\n[scene]\nbuiltin = \"wall\"\n");
        expect_refused(gnomon({"compare", (folder.path() / "job.toml").string()}), 2, words);
    };
    refused("renderer_command = \"touch /tmp/owned\"", "a job file may not hold a command");
    refused("renderer = \"touch /tmp/owned\"", "a job file may not hold a command");
    refused("renderer.command = [\"touch\"]", "a job file may not hold a command");
    refused("renderer = \"no_such_engine\"", "renderer \"no_such_engine\": not installed");
    folder.write("job.toml", "renderer = \"three\"\n[scene]\nbuiltin = \"wall\"\n");
    expect_refused(gnomon({"presets", "--compare", (folder.path() / "job.toml").string()}), 2,
                   "drive other renderers");
}

TEST(SweptRenderer, IsStartedOnceAndWritesItsKeysAsColumns)
{
    const FakeRenderer renderer{"biased"};
    const TemporaryFolder folder;
    const std::string run = (folder.path() / "run").string();
    const Ending ending = driven(renderer, "sweep",
                                 {"--out", run, "--quiet", "--axis", "engine.bias=0,0.001,0.5",
                                  "--axis", "shadow_map.resolution=256,512"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    EXPECT_EQ(renderer.starts(), 1);
    const auto rows = rows_of(text_of(folder.path() / "run/results.csv"));
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[2].at("engine.bias"), "0.001");
    EXPECT_EQ(rows[2].at("engine.kind"), "hard");
    EXPECT_EQ(rows[2].at("shadow_map.resolution"), "256");
    EXPECT_EQ(rows[2].at("bias.constant"), ""); // Gnomon's default is not the renderer's
    EXPECT_EQ(rows[2].at("false_shadow"), "0");
    EXPECT_NE(rows[0].at("false_shadow"), "0");
    EXPECT_NE(rows[4].at("false_lit"), "0");
    EXPECT_EQ(gnomon({"report", run}).exit_code, 0);
    const std::string page = text_of(folder.path() / "run/report.html");
    EXPECT_THAT(page, HasSubstr("engine.bias"));
    // Causes are unknown for a mask alone; 0 would be a claim.
    EXPECT_THAT(page, HasSubstr("<p>Causes and names of the errors are not known"));
    EXPECT_THAT(page, Not(HasSubstr("<caption>By cause</caption>")));
    const std::string summary = text_of(folder.path() / "run/summary.md");
    EXPECT_THAT(summary, HasSubstr("Causes and names of the errors are not known"));
    EXPECT_THAT(summary, Not(HasSubstr("By cause")));
    renderer.expect_nothing_left();
}

TEST(SweptRenderer, FailsOneConfigurationAndIsStartedAgain)
{
    const FakeRenderer renderer{"dies_of_soft"};
    const TemporaryFolder folder;
    const Ending ending = driven(renderer, "sweep",
                                 {"--out", (folder.path() / "run").string(), "--quiet", "--axis",
                                  "engine.kind=hard,soft", "--axis", "engine.bias=0,0.5"});
    EXPECT_EQ(ending.exit_code, 5) << ending.err;
    const auto rows = rows_of(text_of(folder.path() / "run/results.csv"));
    ASSERT_EQ(rows.size(), 4U);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const bool is_soft = i >= 2;
        EXPECT_EQ(rows[i].at("status"), is_soft ? "failed" : "done");
        EXPECT_THAT(rows[i].at("message"),
                    HasSubstr(is_soft ? "its last words: soft shadows need a newer driver" : ""));
    }
    EXPECT_EQ(renderer.starts(), 2); // after the first failure; nothing is drawn after the second
    renderer.expect_nothing_left();
}

/// The message or "done" of each configuration of a sweep.
std::vector<std::string> swept(const FakeRenderer& renderer, const std::string& axis)
{
    const TemporaryFolder folder;
    const Ending ending = driven(
        renderer, "sweep",
        {"--out", (folder.path() / "run").string(), "--quiet", "--no-keep-pixels", "--axis", axis});
    EXPECT_EQ(ending.exit_code, 5) << ending.err;
    std::vector<std::string> messages;
    for (const auto& row : rows_of(text_of(folder.path() / "run/results.csv"))) {
        messages.push_back(row.at("status") == "done" ? "done" : row.at("message"));
    }
    renderer.expect_nothing_left();
    return messages;
}

TEST(SweptRenderer, FailsConfigurationsWhoseFilesAreOlderThanTheRequest)
{
    const FakeRenderer renderer{"links_old_files"};
    EXPECT_THAT(swept(renderer, "engine.bias=0,0.1,0.2"),
                ElementsAre("done", HasSubstr("draw: files.position: an old frame: "), "done"));
}

TEST(SweptRenderer, FailsConfigurationsWhoseMaskIsAnotherLights)
{
    const FakeRenderer renderer{"old_frame"};
    EXPECT_THAT(swept(renderer, "scene.wall.light_angle_deg=30,60"),
                ElementsAre("done", HasSubstr("draw: an old frame: its mask equals the last one")));
}

TEST(SweptRenderer, LetsLightsShareAMaskThatLightsAll)
{
    const FakeRenderer renderer{"biased"};
    const TemporaryFolder folder;
    const Ending ending = driven(renderer, "sweep",
                                 {"--out", (folder.path() / "run").string(), "--quiet", "--set",
                                  "engine.bias=1", "--axis", "scene.wall.light_angle_deg=30,60"});
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
}

TEST(SweptRenderer, GoesOnWhereItWasStoppedToTheSameResults)
{
    const FakeRenderer renderer{"is_slow"};
    const TemporaryFolder folder;
    const auto sweep = [&](const std::string& run, const Start& start) {
        return driven(renderer, "sweep",
                      {"--out", (folder.path() / run).string(), "--quiet", "--no-keep-pixels",
                       "--axis", "engine.bias=0,0.1,0.2,0.3,0.4,0.5,0.6,0.7"},
                      start);
    };
    ASSERT_EQ(sweep("whole", renderer.start()).exit_code, 0);
    for (const int signal : {SIGINT, SIGKILL}) {
        Start stopped = renderer.start();
        stopped.while_running = [signal](pid_t process) {
            std::this_thread::sleep_for(std::chrono::milliseconds{1500});
            ::kill(process, signal);
        };
        (void)sweep(fmt::format("stopped{}", signal), stopped);
        ASSERT_EQ(sweep(fmt::format("stopped{}", signal), renderer.start()).exit_code, 0);
        EXPECT_EQ(text_of(folder.path() / fmt::format("stopped{}/results.csv", signal)),
                  text_of(folder.path() / "whole/results.csv"));
    }
    renderer.expect_nothing_left();
}

TEST(GatedRenderer, IsHeldToItsBaseline)
{
    const FakeRenderer renderer{"biased"};
    const TemporaryFolder folder;
    const auto compare = [&](const std::string& run, const std::string& bias) {
        return driven(renderer, "compare",
                      {"--out", (folder.path() / run).string(), "--set", "engine.bias=" + bias});
    };
    const std::string baseline = (folder.path() / "baseline.json").string();
    ASSERT_EQ(compare("good", "0.001").exit_code, 0);
    const Ending saved =
        gnomon({"baseline", "save", (folder.path() / "good").string(), "--baseline", baseline});
    ASSERT_EQ(saved.exit_code, 0) << saved.err;
    const auto gate = [&](const std::string& run) {
        return gnomon({"gate", (folder.path() / run).string(), "--baseline", baseline});
    };
    ASSERT_EQ(compare("again", "0.001").exit_code, 0);
    EXPECT_EQ(gate("again").exit_code, 0);
    ASSERT_EQ(compare("worse", "0.5").exit_code, 0);
    const Ending worse = gate("worse");
    EXPECT_EQ(worse.exit_code, 1) << worse.err;
    EXPECT_THAT(worse.out, HasSubstr("engine.bias"));
}

TEST(TunedRenderer, FindsABetterBiasAndDrawsItAgain)
{
    const FakeRenderer renderer{"biased"};
    const Ending ending = driven(renderer, "tune", {"--json", "--budget", "60", "--quiet"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const auto json = nlohmann::json::parse(ending.out);
    EXPECT_GT(json.at("own").at("shadow_amount"), 0.0);
    EXPECT_EQ(json.at("recommended").at("shadow_amount"), 0.0);
    EXPECT_EQ(json.at("recommended").at("light_amount"), 0.0);
    const double bias = json.at("recommended").at("engine").at("bias");
    EXPECT_GE(bias, 0.001); // where its acne ends
    EXPECT_LE(json.at("tried").size(), 60U);
    EXPECT_LE(json.at("recommended").at("mean_amount_rate"), json.at("own").at("mean_amount_rate"));
    EXPECT_EQ(json.at("not_searched").size(), 2U) << "smooth and kind do nothing";
    renderer.expect_nothing_left();
}

TEST(TunedRenderer, DoesNotCountAFrameThatHidesWhatIsWrong)
{
    const FakeRenderer renderer{"hides"};
    const Ending ending = driven(renderer, "tune", {"--json", "--budget", "60", "--quiet"});
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
    const auto json = nlohmann::json::parse(ending.out);
    EXPECT_EQ(json.at("recommended").at("engine").at("kind"), "hard");
    EXPECT_EQ(json.at("not_searched").at("kind"), "changes what is seen");
    for (const auto& tried : json.at("tried")) {
        EXPECT_EQ(tried.contains("message"), tried.at("engine").at("kind") == "soft") << tried;
    }
    renderer.expect_nothing_left();
}

} // namespace
} // namespace gnomon::testing
