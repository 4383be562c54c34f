#include "store/run_folder/run_lock.hpp"

#include "child.hpp"
#include "example_comparison.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <string>

namespace gnomon::store {
namespace {

using testing::AllOf;
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
    // The one kind of folder that even root cannot write to.
    try {
        const RunLock lock{"/proc/self"};
        ADD_FAILURE() << "locked /proc/self";
    } catch (const scene::EnvironmentError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("/proc/self/lock"), HasSubstr("open"),
                                        HasSubstr("choose a folder that may be written")));
    }
}

TEST(RunLock, SaysThatAFileIsNoFolder)
{
    const TemporaryFolder folder;
    std::ofstream{folder / "lock"} << "text";
    EXPECT_THROW(RunLock{folder / "lock"}, scene::EnvironmentError);
}

} // namespace
} // namespace gnomon::store
