#include "store/run_folder/run_lock.hpp"

#include "child.hpp"
#include "example_comparison.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>

namespace gnomon::store {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;

std::string refusal(const std::filesystem::path& folder)
{
    try {
        const RunLock lock{folder};
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return "taken";
}

TEST(RunLock, MakesTheFolder)
{
    const TemporaryFolder folder;
    const RunLock lock{folder / "a/run"};
    EXPECT_TRUE(std::filesystem::is_regular_file(folder / "a/run/lock"));
}

TEST(RunLock, IsFreeAgainWhenItsOwnerIsDone)
{
    const TemporaryFolder folder;
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(refusal(folder.path()), "taken");
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "lock"));
}

TEST(RunLock, NamesTheProcessThatHoldsIt)
{
    const TemporaryFolder folder;
    const Child child{[&](const Child::Ready& ready) {
        const RunLock lock{folder.path()};
        ready();
        ::pause();
    }};
    EXPECT_THAT(refusal(folder.path()),
                AllOf(HasSubstr(fmt::format("another process is writing here (process {} on ",
                                            child.pid())),
                      HasSubstr("since 2"), HasSubstr("UTC"), HasSubstr("store_tests"),
                      HasSubstr("wait for it, or name another folder"), Not(HasSubstr("\n"))));
}

TEST(RunLock, IsNotHeldByTheDead)
{
    const TemporaryFolder folder;
    {
        Child child{[&](const Child::Ready& ready) {
            const RunLock lock{folder.path()};
            ready();
            ::pause();
        }};
        child.kill();
    }
    EXPECT_THAT(read_text(folder / "lock"), HasSubstr("process")); // what it left does not count
    EXPECT_EQ(refusal(folder.path()), "taken");
}

TEST(RunLock, SaysThatAFolderMayNotBeWritten)
{
    // Not even root can write to /proc.
    try {
        const RunLock lock{"/proc/self"};
        ADD_FAILURE() << "locked /proc/self";
    } catch (const scene::EnvironmentError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("/proc/self/lock"), HasSubstr("open"),
                                        HasSubstr("choose a writable folder")));
    }
}

TEST(RunLock, SaysThatAFileIsNoFolder)
{
    const TemporaryFolder folder;
    std::ofstream{folder / "lock"} << "text";
    EXPECT_THROW(RunLock{folder / "lock"}, scene::EnvironmentError);
}

/// The paths in the folder, relative to it.
std::set<std::string> entries_below(const std::filesystem::path& folder)
{
    std::set<std::string> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator{folder}) {
        entries.insert(entry.path().lexically_relative(folder).string());
    }
    return entries;
}

void touch_below(const std::filesystem::path& folder, const std::string& name)
{
    std::filesystem::create_directories((folder / name).parent_path());
    write_file(folder / name, "text");
}

TEST(Leftovers, AreTheTemporariesOfTheRunsOwnFiles)
{
    const TemporaryFolder folder;
    for (const char* const name :
         {".results.csv.4711-0.tmp", ".error_vs_z.csv.1-12.tmp", ".bias_curves.csv.99999-3.tmp",
          ".by_map.csv.4711-3.tmp", "pixels/.0123456789abcdef.exr.4711-0.tmp",
          "pixels/.fedcba9876543210.exr.4711-1.tmp"}) {
        touch_below(folder.path(), name);
    }
    remove_leftovers(folder.path());
    EXPECT_THAT(entries_below(folder.path()), ElementsAre("pixels"));
}

TEST(Leftovers, AreNothingElse)
{
    const TemporaryFolder folder;
    const std::set<std::string> others{".depth.csv.4711-0.tmp", // somebody's `depth --csv`
                                       ".results.csv.4711.tmp",
                                       ".results.csv.4711-.tmp",
                                       ".results.csv.-0.tmp",
                                       ".results.csv.4711-0.tmp~",
                                       ".results.csv.x-0.tmp",
                                       "results.csv",
                                       "results.csv.4711-0.tmp",
                                       "results.sqlite",
                                       ".0123456789abcdef.exr.4711-0.tmp",
                                       "pixels/.results.csv.4711-0.tmp",
                                       "pixels/.0123456789abcde.exr.4711-0.tmp",
                                       "pixels/.0123456789abcdeF.exr.4711-0.tmp",
                                       "pixels/.0123456789abcdef0.exr.4711-0.tmp",
                                       "pixels/.0123456789abcdef.png.4711-0.tmp",
                                       "pixels/0123456789abcdef.exr",
                                       "pixels/deeper/.0123456789abcdef.exr.4711-0.tmp",
                                       "elsewhere/.results.csv.4711-0.tmp"};
    for (const std::string& name : others) {
        touch_below(folder.path(), name);
    }
    std::filesystem::create_directory(folder / ".results.csv.1-1.tmp");
    std::filesystem::create_symlink("results.csv", folder / ".results.csv.2-2.tmp");
    const std::set<std::string> before = entries_below(folder.path());
    remove_leftovers(folder.path());
    EXPECT_THAT(entries_below(folder.path()), ElementsAreArray(before));
}

TEST(Leftovers, AreLookedForInVainWhereThereIsNoFolder)
{
    const TemporaryFolder folder;
    remove_leftovers(folder / "none");
    EXPECT_EQ(folder.entry_count(), 0U);
}

TEST(Leftovers, GoWhenTheRunIsLockedAgain)
{
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "pixels");
    {
        Child child{[&](const Child::Ready& ready) {
            const RunLock lock{folder.path()};
            const OutputFile results{folder / "results.csv"};
            const OutputFile layers{folder / "pixels/0123456789abcdef.exr"};
            ready();
            ::pause();
        }};
        child.kill();
    }
    ASSERT_EQ(entries_below(folder.path()).size(), 4U) << "lock, pixels, two temporary files";
    const RunLock lock{folder.path()};
    EXPECT_THAT(entries_below(folder.path()), ElementsAre("lock", "pixels"));
}

} // namespace
} // namespace gnomon::store
