#include "child_process.hpp"
#include "example_run.hpp"
#include "store/run_folder/run_lock.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using store::ExampleRun;
using store::RunStore;

const ExampleRun divided{4, 3, 2};

std::string place(const TemporaryFolder& folder, const std::string& name)
{
    return (folder.path() / name).string();
}

/// A run of everything but the last curve, whose first configuration failed.
void make_incomplete(const std::string& folder, const ExampleRun& run)
{
    std::filesystem::create_directories(folder);
    RunStore store{folder, RunStore::Access::write};
    store.plan(run.description(), run.configurations());
    const std::uint64_t last = run.curves - 1;
    run.record(store, 1, {last});
    store.record_failure(std::vector<std::uint64_t>{last * run.biases}, "no memory");
}

TEST(StatusCommand, EndsWithZeroWhenAllIsDone)
{
    const TemporaryFolder folder;
    ExampleRun{2, 2}.compute(folder.path());
    const Ending ending = gnomon({"status", folder.path().string()});
    expect_done(ending);
    EXPECT_NE(ending.out.find(": 4 of 4 configurations done, 0 failed, 0 missing\n"),
              std::string::npos)
        << ending.out;
}

TEST(StatusCommand, EndsWithFiveAndSaysHowToResume)
{
    const TemporaryFolder folder;
    const std::string run = place(folder, "run");
    make_incomplete(run, {2, 30});
    const Ending ending = gnomon({"status", run});
    EXPECT_EQ(ending.exit_code, 5);
    EXPECT_EQ(ending.err, "");
    EXPECT_NE(ending.out.find(": 30 of 60 configurations done, 1 failed, 29 missing\n"),
              std::string::npos)
        << ending.out;
    EXPECT_NE(ending.out.find("  and 9 more\n"), std::string::npos) << ending.out;
    EXPECT_NE(
        ending.out.find("resume with\n  gnomon sweep job.toml --out " + run + " --retry failed\n"),
        std::string::npos)
        << ending.out;
    const Ending all = gnomon({"status", run, "--all"});
    EXPECT_EQ(all.exit_code, 5);
    EXPECT_EQ(all.out.find("more\n"), std::string::npos) << all.out;
    EXPECT_NE(all.out.find("\n  59  case noon"), std::string::npos) << all.out;
}

TEST(StatusCommand, PrintsJson)
{
    const TemporaryFolder folder;
    const std::string run = place(folder, "run");
    make_incomplete(run, {2, 30});
    const Ending ending = gnomon({"status", run, "--json", "--all"});
    EXPECT_EQ(ending.exit_code, 5);
    const Json status = Json::parse(ending.out);
    EXPECT_EQ(status.at("missing"), 29);
    EXPECT_EQ(status.at("missing_configurations").size(), 29U);
    EXPECT_EQ(status.at("failed_configurations").at(0).at("message"), "no memory");
}

TEST(StatusCommand, RefusesFoldersWithoutARun)
{
    const TemporaryFolder folder;
    expect_refused(gnomon({"status", folder.path().string()}), 2, "there is no results.sqlite");
    expect_refused(gnomon({"status", place(folder, "none")}), 2, "there is no results.sqlite");
    expect_refused(gnomon({"status"}), 2, "RUN is required");
    folder.write("run/results.sqlite", std::string(4096, 'x'));
    expect_refused(gnomon({"status", place(folder, "run")}), 2, "is damaged, or not a database");
}

TEST(MergeCommand, UnitesShardsToTheUndividedRun)
{
    const TemporaryFolder folder;
    divided.compute(folder.path() / "1", 1);
    divided.compute(folder.path() / "2", 2);
    ExampleRun{divided.curves, divided.biases}.compute(folder.path() / "whole");
    const Ending ending =
        gnomon({"merge", place(folder, "all"), place(folder, "1"), place(folder, "2")});
    expect_done(ending);
    EXPECT_NE(ending.out.find("12 of 12 configurations done"), std::string::npos) << ending.out;
    EXPECT_EQ(store::csv_texts(folder.path() / "all"), store::csv_texts(folder.path() / "whole"));
    expect_refused(gnomon({"merge", place(folder, "all"), place(folder, "1")}), 2,
                   "holds a run already");
}

TEST(MergeCommand, LeavesNoLockAndNoFolderThatIsEmpty)
{
    const TemporaryFolder folder;
    divided.compute(folder.path() / "1", 1);
    EXPECT_EQ(gnomon({"merge", place(folder, "all"), place(folder, "1")}).exit_code, 5);
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "all" / "lock"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "all" / "results.csv"));
    expect_refused(gnomon({"merge", place(folder, "new"), place(folder, "none")}), 2,
                   "there is no results.sqlite");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
}

TEST(MergeCommand, RepeatsThatGlDisagreesWithTheCurve)
{
    const TemporaryFolder folder;
    const ExampleRun run{2, 2};
    std::filesystem::create_directory(folder.path() / "run");
    {
        RunStore store{folder.path() / "run", RunStore::Access::write};
        store.plan(run.description(), run.configurations());
        run.record(store);
        gnomon::analysis::FinishedCurve curve = run.curve(1);
        curve.curve.verification = gnomon::analysis::BiasVerification{{{0, 60, 40, 3}}};
        store.record(curve);
    }
    const Ending status = gnomon({"status", place(folder, "run")});
    EXPECT_EQ(status.exit_code, 4);
    EXPECT_NE(status.out.find("  verified: 1 of 2 bias curves, 3 of 100 verdicts differ\n"),
              std::string::npos)
        << status.out;
    const Json json = Json::parse(gnomon({"status", place(folder, "run"), "--json"}).out);
    EXPECT_EQ(json.at("complete"), true);
    EXPECT_EQ(json.at("mismatched"), 0);
    EXPECT_EQ(json.at("verification").at("differences"), 3);
    EXPECT_EQ(gnomon({"merge", place(folder, "all"), place(folder, "run")}).exit_code, 4);
    EXPECT_EQ(gnomon({"status", place(folder, "all")}).exit_code, 4);
}

TEST(MergeCommand, EndsWithFiveIfSomethingIsMissing)
{
    const TemporaryFolder folder;
    divided.compute(folder.path() / "1", 1);
    const Ending ending = gnomon({"merge", place(folder, "all"), place(folder, "1")});
    EXPECT_EQ(ending.exit_code, 5);
    EXPECT_NE(ending.out.find("6 of 12 configurations done, 0 failed, 6 missing"),
              std::string::npos)
        << ending.out;
}

TEST(MergeCommand, AsksBeforeItMixesEnvironments)
{
    const TemporaryFolder folder;
    divided.compute(folder.path() / "1", 1);
    std::filesystem::create_directory(folder.path() / "2");
    {
        store::RunDescription description = divided.description(2);
        description.environment.embree = "Embree 4.3.0";
        RunStore store{folder.path() / "2", RunStore::Access::write};
        store.plan(description, divided.configurations());
        divided.record(store, 2);
    }
    const std::vector<std::string> merge{"merge", place(folder, "all"), place(folder, "1"),
                                         place(folder, "2")};
    expect_refused(gnomon(merge), 2, "pass --allow-mixed");
    std::vector<std::string> allowed = merge;
    allowed.emplace_back("--allow-mixed");
    expect_done(gnomon(allowed));
}

TEST(MergeCommand, WaitsForNobodyWhoWritesThere)
{
    const TemporaryFolder folder;
    divided.compute(folder.path() / "1", 1);
    const store::RunLock lock{folder.path() / "all"};
    expect_refused(gnomon({"merge", place(folder, "all"), place(folder, "1")}), 2,
                   fmt::format("another process is writing here (process {} on ", ::getpid()));
}

TEST(MergeCommand, RefusesWrongUsage)
{
    const TemporaryFolder folder;
    expect_refused(gnomon({"merge"}), 2, "OUT is required");
    expect_refused(gnomon({"merge", place(folder, "all")}), 2, "RUN");
    expect_refused(gnomon({"merge", place(folder, "all"), place(folder, "none")}), 2,
                   "there is no results.sqlite");
}

} // namespace
} // namespace gnomon::testing
