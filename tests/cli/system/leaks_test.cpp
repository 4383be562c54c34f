#include "child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

/// GCC 12's LeakSanitizer crashes now and then while a GL driver's threads end.
bool checker_crashed(const Ending& ending)
{
    return ending.err.find("LeakSanitizer has encountered a fatal error") != std::string::npos;
}

/// Runs the program with LeakSanitizer; repeats if that crashes.
Ending checked_for_leaks(const std::vector<std::string>& arguments)
{
    constexpr int most_tries = 5;
    Start start;
    start.environment = {"ASAN_OPTIONS=detect_leaks=1"};
    Ending ending = gnomon(arguments, start);
    for (int tries = 1; tries < most_tries && checker_crashed(ending); ++tries) {
        ending = gnomon(arguments, start);
    }
    return ending;
}

void expect_no_leak(const std::vector<std::string>& arguments, int exit_code = 0)
{
    const Ending ending = checked_for_leaks(arguments);
    SCOPED_TRACE(ending.command);
    EXPECT_EQ(ending.exit_code, exit_code) << ending.err;
    EXPECT_THAT(ending.err, ::testing::Not(::testing::HasSubstr("LeakSanitizer")));
}

TEST(Leaks, AreNotInTheCommandsThatRender)
{
    const TemporaryFolder folder;
    const std::string place = folder.path();
    expect_no_leak(small({"compare", "--builtin", "columns", "--aov", place + "/a.exr", "--picture",
                          place + "/p.png", "--depth-map", place + "/m.exr", "--export-case",
                          place + "/case"}));
    expect_no_leak(small({"tune", "--builtin", "wall", "--max-resolution", "512"}));
    expect_no_leak({"depth", "--near", "4", "--far", "50", "--bits", "16", "--json"});
    expect_no_leak({"doctor"});
    expect_no_leak({"evaluate", place + "/case", "--out", place + "/evaluated"});
    expect_no_leak(small({"certify", place + "/a.exr", "--builtin", "columns", "--sample", "20"}));
}

TEST(Leaks, AreNotInTheFiltersAndAdvice)
{
    for (const char* const filter : {"linear", "hardware", "pcf5"}) {
        expect_no_leak(small({"compare", "--builtin", "yard", "--advise", "--set",
                              std::string{"lookup.filter="} + filter, "--set",
                              "shadow_map.depth_format=u12", "--set", "bias.normal_texels=1"}));
    }
}

TEST(Leaks, AreNotInTheCommandsThatOnlyPrint)
{
    const TemporaryFolder folder;
    expect_no_leak({"scenes", "--json"});
    expect_no_leak({"methods", "--json"});
    expect_no_leak({"init"});
    expect_no_leak({"completion", "bash"});
    expect_no_leak({"capture-kit", (folder.path() / "kit").string()});
}

TEST(Leaks, AreNotInTheCommandsOfARun)
{
    const TemporaryFolder folder;
    const std::string run = (folder.path() / "run").string();
    const std::string baseline = (folder.path() / "baseline.json").string();
    expect_no_leak(small({"sweep", "--builtin", "wall", "--axis", "bias.constant=[0.0, 0.01]",
                          "--out", run, "--quiet"}));
    expect_no_leak({"status", run});
    expect_no_leak({"baseline", "save", run, "--baseline", baseline});
    expect_no_leak({"gate", run, "--baseline", baseline});
    expect_no_leak({"baseline", "list", baseline});
    expect_no_leak({"baseline", "diff", baseline, run});
    expect_no_leak({"merge", (folder.path() / "merged").string(), run});
    expect_no_leak({"report", run, "--no-figures"});
}

TEST(Leaks, AreNotInARefusal)
{
    expect_no_leak({"compare", "/nonexistent.toml"}, 2);
    expect_no_leak({"compare", "--builtin", "none"}, 2);
}

} // namespace
} // namespace gnomon::testing
